#include "dynamics/passage.hpp"

#include "dynamics/rosenbrock.hpp"

#include <boost/math/tools/roots.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/dense_output_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <limits>

namespace bristle {
namespace odeint = boost::numeric::odeint;
namespace {

// A tip that ends within this many repulsion ranges of the axis is held there: pinned.
constexpr double kPinnedRanges = 20;
// Where the explicit method hands over: a bristle that needs more steps than an ordinary passage,
// or comes so near the axis that c_theta/s^2 makes it stiff.
constexpr long kExplicitSteps = 6000;
constexpr double kStiffRanges = 4;

// A pinned bristle oscillates undamped about its place; its means do not depend on the phase, so its
// tolerance may be looser (docs/numerics.md has the measurement).
constexpr double kImplicitFactor = 10;

constexpr double kFirstStep = 1e-5;
constexpr double kTimeTolerance = 1e-13;

struct EvaluationLimit {};

// The right-hand side as Odeint calls it, with the cap on its evaluations.
struct System {
  const Bristle<double>& bristle;
  long evaluations;
  long limit;

  void derivative(const OdeState& y, OdeState& dydt) {
    if (++evaluations > limit) throw EvaluationLimit{};
    bristle::derivative<double>(bristle, y, dydt);
  }
  void operator()(const OdeState& y, OdeState& dydt, double) { derivative(y, dydt); }
  void jacobian(const OdeState& y, StateJacobian& J, IntegralJacobian& J_integrals) {
    bristle::jacobian(bristle, y, J, J_integrals);
  }
};

// Largest error over tolerance. A step that is not finite is an infinite error: Odeint's own
// checker takes NaN for a success.
class ErrorChecker {
 public:
  ErrorChecker(double atol, double rtol) : atol_(atol), rtol_(rtol) {}
  template <class Algebra>
  double error(Algebra&, const OdeState& y, const OdeState&, const OdeState& y_err, double) const {
    double largest = 0;
    for (int i = 0; i < COMPONENTS; ++i) {
      const double e = std::abs(y_err[i]) / (atol_ + rtol_ * std::abs(y[i]));
      if (!(e < 1e6)) return 1e6;
      largest = std::max(largest, e);
    }
    return largest;
  }

 private:
  double atol_, rtol_;
};

using Dopri5 = odeint::runge_kutta_dopri5<OdeState>;
using ControlledDopri5 = odeint::controlled_runge_kutta<Dopri5, ErrorChecker>;
using ExplicitStepper = odeint::dense_output_runge_kutta<ControlledDopri5>;
using ImplicitController = odeint::rosenbrock4_controller<Rosenbrock4>;
using ImplicitStepper = odeint::rosenbrock4_dense_output<ImplicitController>;

double in_plane_distance(const OdeState& y) { return std::hypot(y[X], y[Y]); }
double radial_product(const OdeState& y) { return y[X] * y[VX] + y[Y] * y[VY]; }

// First time in [a, b] at which g, with g(a) < 0 <= g(b), is zero.
template <class G>
double root_in(G g, double a, double b) {
  std::uintmax_t iterations = 100;
  const double g_a = g(a), g_b = g(b);
  if (g_a >= 0) return a;
  if (g_b <= 0) return b;
  const auto close = [](double l, double r) { return r - l <= kTimeTolerance; };
  const auto bracket = boost::math::tools::toms748_solve(g, a, b, g_a, g_b, close, iterations);
  return bracket.second;
}

class Run {
 public:
  Run(const Parameters& p, const Bristle<double>& b, const OdeState& start, const IntegratorOptions& options,
      const Observer& observe)
      : p_(p),
        options_(options),
        observe_(observe),
        x_0_(start[X]),
        y_(start),
        system_{b, 0, options.max_evaluations} {}

  Outcome integrate() {
    if (observe_) observe_(t_, y_);
    try {
      End end = End::hand_over;
      if (options_.method != Method::implicit_only) end = advance_explicit();
      if (end == End::hand_over) {
        implicit_ = true;
        end = advance_implicit();
      }
      const bool at_axis = in_plane_distance(y_) < kPinnedRanges * p_.lambda;
      return at_axis ? Outcome::pinned : Outcome::left;
    } catch (const EvaluationLimit&) {
      return Outcome::step_limit;
    } catch (const odeint::odeint_error&) {  // no step size was small enough
      return Outcome::not_finite;
    }
  }

  void report(Passage& out) const {
    out.contact_time = t_;
    out.end = y_;
    out.steps = steps_;
    out.evaluations = system_.evaluations;
    out.reflections = reflections_;
    out.implicit = implicit_;
  }

 private:
  enum class End {
    exit,
    hand_over
  };

  End advance_explicit() {
    ExplicitStepper stepper(ControlledDopri5(ErrorChecker(options_.atol, options_.rtol)));
    return advance(stepper, [this] {
      return options_.method == Method::automatic &&
             (steps_ >= kExplicitSteps || in_plane_distance(y_) < kStiffRanges * p_.lambda);
    });
  }

  End advance_implicit() {
    ImplicitStepper stepper(
        ImplicitController(kImplicitFactor * options_.atol, kImplicitFactor * options_.rtol));
    return advance(stepper, [] { return false; });
  }

  // Steps until the exit or until hand_over(); leaves time and state there.
  template <class Stepper, class HandOver>
  End advance(Stepper& stepper, HandOver hand_over) {
    stepper.initialize(y_, t_, dt_);
    while (!hand_over()) {
      const auto [from, to] = stepper.do_step(std::ref(system_));
      ++steps_;
      const double pole = pole_contact(stepper, from, to);
      const double end = std::min(pole, to);
      const OdeState at_end = end < to ? state_at(stepper, end) : stepper.current_state();
      const bool exits = slip(end, at_end) >= p_.L_x;
      if (exits) {
        t_ = root_in([&](double t) { return slip(t, state_at(stepper, t)) - p_.L_x; }, from, end);
        y_ = state_at(stepper, t_);
      } else {
        t_ = end;
        y_ = at_end;
        dt_ = stepper.current_time_step();
      }
      if (!exits && pole <= to) {
        reflect();
        stepper.initialize(y_, t_, std::min(dt_, kFirstStep));
      }
      if (observe_) observe_(t_, y_);
      if (exits) return End::exit;
    }
    return End::hand_over;
  }

  double slip(double t, const OdeState& y) const { return t - (y[X] - x_0_); }

  template <class Stepper>
  static OdeState state_at(Stepper& stepper, double t) {
    OdeState y;
    stepper.calc_state(t, y);
    return y;
  }

  // Time at which the tip comes down to s = s_min within the step, or infinity. The step's closest
  // approach counts, so that a step across the axis is not missed.
  template <class Stepper>
  double pole_contact(Stepper& stepper, double from, double to) const {
    constexpr double never = std::numeric_limits<double>::infinity();
    const OdeState &before = stepper.previous_state(), &after = stepper.current_state();
    if (radial_product(before) >= 0) return never;
    double nearest = to;
    if (radial_product(after) > 0)
      nearest = root_in([&](double t) { return radial_product(state_at(stepper, t)); }, from, to);
    const auto inside = [&](double t) { return p_.s_min - in_plane_distance(state_at(stepper, t)); };
    if (inside(nearest) < 0) return never;
    return root_in(inside, from, nearest);
  }

  // The pole rule: the in-plane radial velocity changes sign, all else stays.
  void reflect() {
    const double s = in_plane_distance(y_), inward = radial_product(y_) / s;
    if (inward >= 0) return;
    y_[VX] -= 2 * inward * y_[X] / s;
    y_[VY] -= 2 * inward * y_[Y] / s;
    ++reflections_;
  }

  const Parameters& p_;
  const IntegratorOptions& options_;
  const Observer& observe_;
  double x_0_, t_ = 0, dt_ = kFirstStep;
  OdeState y_;
  System system_;
  long steps_ = 0;
  int reflections_ = 0;
  bool implicit_ = false;
};

void derive_ratios(Passage& out) {
  const double T = out.contact_time, I_n = out.end[NORMAL];
  out.gamma_1 = out.end[MODULATION] / I_n;
  out.gamma_2 = out.end[ALIGNMENT] / I_n;
  const double mean_root = std::cbrt(I_n / T);
  out.gamma_3 = out.end[AREA] / T / (mean_root * mean_root);
}

}  // namespace

Passage run_passage(const Parameters& p, const Bristle<double>& b, const Equilibrium& start,
                    const IntegratorOptions& options, const Observer& observe) {
  Passage out;
  out.theta_0 = b.theta_0;
  const State<double> at_rest = state_at_rest(b, start);
  Run run(p, b, pack(at_rest), options, observe);
  out.outcome = run.integrate();
  run.report(out);
  if (!out.complete()) return out;

  derive_ratios(out);
  const double gained = energy(b, unpack<double>(out.end)) - energy(b, at_rest);
  const double dissipated = out.end[FRICTION_X] - out.end[WORK];
  out.energy_residual = std::abs(gained - out.end[WORK]) / dissipated;
  return out;
}

}  // namespace bristle
