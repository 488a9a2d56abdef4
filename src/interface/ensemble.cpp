#include "interface/ensemble.hpp"

#include "interface/quadrature.hpp"

#include <cmath>
#include <optional>

namespace bristle {
namespace {

// A decision against a target stops at this many times the tolerance: nearer, the full mean has to say.
constexpr double kDecisionFactor = 4;

ObservableArray observables(const Passage& passage, double L_x) {
  const bool pinned = passage.outcome == Outcome::pinned;
  const double R_n = passage.end[NORMAL] / L_x, R_x = passage.end[FRICTION_X] / L_x;
  ObservableArray o{};
  o[N_C_RATIO] = passage.contact_time / L_x;
  o[R_N] = R_n;
  o[R_X] = R_x;
  o[R_Y] = passage.end[FRICTION_Y] / L_x;
  o[GAMMA_1] = passage.gamma_1;
  o[GAMMA_2] = passage.gamma_2;
  o[GAMMA_3] = passage.gamma_3;
  o[PINNED_FRACTION] = pinned ? 1 : 0;
  o[PINNED_R_N] = pinned ? R_n : 0;
  o[PINNED_R_X] = pinned ? R_x : 0;
  o[ENERGY_RESIDUAL] = passage.energy_residual;
  return o;
}

QuadratureOptions<OBSERVABLES> quadrature_options(const Orientation& orientation, bool half_circle,
                                                  std::optional<double> R_n_target) {
  QuadratureOptions<OBSERVABLES> options;
  for (std::size_t k = 0; k < OBSERVABLES; ++k) options.scale[k] = int(k);
  options.scale[R_Y] = R_X;  // R_y is near zero: measured against R_x
  options.decide_about = R_n_target;
  if (R_n_target) {
    options.rtol[R_N] = kDecisionFactor * orientation.rtol;
  } else {
    for (Observable k : {N_C_RATIO, R_N, R_X, GAMMA_1, GAMMA_2, GAMMA_3}) options.rtol[k] = orientation.rtol;
    if (!half_circle) options.rtol[R_Y] = orientation.rtol;
  }
  // Bristles that point against the motion decide most: a panel of their own.
  const double head_on = M_PI / 6;
  if (half_circle) options.edges = {0, M_PI - head_on, M_PI};
  else options.edges = {-M_PI, -M_PI + head_on, 0, M_PI - head_on, M_PI};
  return options;
}

class Average {
 public:
  Average(const Interface& interface, double z_0, const PassageObserver& observe, Ensemble& out)
      : p_(interface.parameters),
        z_0_(z_0),
        start_(static_equilibrium(make_bristle(p_, z_0, 0))),
        integrator_(interface.integrator),
        observe_(observe),
        out_(out) {}

  Passage passage(double theta_0) {
    const Passage result = run_passage({&p_, make_bristle(p_, z_0_, theta_0), start_, integrator_});
    ++out_.passages;
    if (!result.complete() && out_.incomplete++ == 0) out_.incomplete_theta_0 = theta_0;
    if (observe_) observe_(result);
    return result;
  }

  void by_quadrature(const Orientation& orientation, std::optional<double> R_n_target) {
    const bool half_circle = mirror_symmetric(orientation) && !orientation.full_circle;
    const double images = half_circle ? 2 : 1;
    const Quadrature<OBSERVABLES>::Function integrand = [&](double theta_0) {
      const Passage one = passage(theta_0);
      Sample<OBSERVABLES> sample;
      sample.label = int(one.outcome);
      sample.valid = one.complete();
      sample.value = observables(one, p_.L_x);
      if (half_circle) sample.value[R_Y] = 0;  // cancels against the mirror image
      for (double& value : sample.value) value *= images * density(orientation, theta_0);
      return sample;
    };
    const auto options = quadrature_options(orientation, half_circle, R_n_target);
    const auto result = Quadrature<OBSERVABLES>(integrand, options).integrate();
    out_.mean = result.integral;
    out_.error = result.error;
    out_.converged = result.status == QuadratureStatus::converged;
    out_.jumps = result.jumps;
  }

  void by_list(const std::vector<double>& theta_0) {
    for (double angle : theta_0) {
      const ObservableArray value = observables(passage(angle), p_.L_x);
      for (std::size_t k = 0; k < OBSERVABLES; ++k) out_.mean[k] += value[k] / double(theta_0.size());
    }
  }

 private:
  const Parameters& p_;
  double z_0_;
  Equilibrium start_;
  const IntegratorOptions& integrator_;
  const PassageObserver& observe_;
  Ensemble& out_;
};

Ensemble average(const Interface& interface, double z_0, std::optional<double> R_n_target,
                 const PassageObserver& observe) {
  Ensemble out;
  out.z_0 = z_0;
  Average average(interface, z_0, observe, out);
  if (interface.orientation.sampling == Sampling::list) average.by_list(interface.orientation.theta_0);
  else average.by_quadrature(interface.orientation, R_n_target);
  return out;
}

}  // namespace

Ensemble ensemble_mean(const Interface& interface, double z_0, const PassageObserver& observe) {
  return average(interface, z_0, std::nullopt, observe);
}

Ensemble ensemble_against_target(const Interface& interface, double z_0, double R_n_target) {
  return average(interface, z_0, R_n_target, {});
}

double rigid_friction(const Parameters& p, double R_n) {
  if (p.friction == FrictionLaw::coulomb) return p.mu_c * R_n;
  const double root = std::cbrt(R_n);
  return p.tau_f * hertz_area_factor(p.R_c, p.E_star) * root * root;
}

}  // namespace bristle
