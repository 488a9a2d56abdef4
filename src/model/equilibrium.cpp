#include "model/equilibrium.hpp"

#include "model/energy.hpp"

#include <boost/math/tools/minima.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>

namespace bristle {
namespace {

// A function's value and its derivative.
struct Tangent {
  double value, slope;
};

// The root of a function that is negative at lower and not negative at upper: Newton's method from guess, and
// bisection where a step of Newton's method leaves the bracket or is longer than the one before.
template <class Function>
double bracketed_root(Function function, double lower, double upper, double guess) {
  constexpr double converged = 1e-12;  // a Newton step of this relative size is correct to rounding
  constexpr double rounding = 4e-16;
  constexpr int most_steps = 60;  // of Newton's method, which may be slow far away from the root
  double x = guess > lower && guess < upper ? guess : lower + (upper - lower) / 2;
  double last = upper - lower;
  for (int i = 0;; ++i) {
    const Tangent t = function(x);
    (t.value < 0 ? lower : upper) = x;
    const double step = -t.value / t.slope;
    if (std::abs(step) <= converged * std::abs(x)) return x + step;
    const bool newton = i < most_steps && x + step > lower && x + step < upper && std::abs(step) <= last;
    const double next = newton ? x + step : lower + (upper - lower) / 2;
    last = std::abs(next - x);
    x = next;
    if (last <= rounding * std::abs(x)) return x;
  }
}

// The bristle with its tip at the radius where the radial forces balance, for a polar angle.
class Bent {
 public:
  // z: a guess of the tip's height, such as its height at a similar angle.
  Bent(const Bristle<double>& b, double phi, double z) : b_(b), phi_(phi), sin_(sin(phi)), cos_(cos(phi)) {
    // The radial force increases strictly with r; this is its sign at r = 0.
    if (sin_ * wall_at(0) >= b.k_r + cos_ * b.pole_peak) {
      r_ = std::numeric_limits<double>::quiet_NaN();
    } else {
      const double r_max = 1 + b.pole_peak / b.k_r;
      r_ = bracketed_root([this](double r) { return radial(r); }, 0, r_max, std::min(1.0, z / sin_));
    }
  }

  // NaN if the wall, reaching down to r = 0, compresses the spring completely.
  double r() const { return r_; }
  double z() const { return r_ * sin_; }

  // dU/dphi along the balanced radius, and its derivative. Zero at an equilibrium.
  Tangent polar() const {
    const double s = r_ * cos_, z = r_ * sin_;
    const double wall = wall_at(r_), pole = pole_at(r_), wall_slope = wall * b_.wall_rate,
                 pole_slope = pole * b_.pole_rate;
    const double U_phi_phi = b_.k_phi - z * wall + s * s * wall_slope + s * pole + z * z * pole_slope;
    const double U_r_phi = cos_ * wall + sin_ * s * wall_slope + sin_ * pole - cos_ * z * pole_slope;
    const double U_r_r = b_.k_r + sin_ * sin_ * wall_slope + cos_ * cos_ * pole_slope;
    return {b_.k_phi * (phi_ - b_.phi_0) + s * wall + z * pole, U_phi_phi - U_r_phi * U_r_phi / U_r_r};
  }

 private:
  double wall_at(double r) const { return short_range_force(b_.z_0 - r * sin_, b_.wall_peak, b_.wall_rate); }
  double pole_at(double r) const { return short_range_force(r * cos_, b_.pole_peak, b_.pole_rate); }

  Tangent radial(double r) const {
    const double wall = wall_at(r), pole = pole_at(r);
    return {b_.k_r * (r - 1) + sin_ * wall - cos_ * pole,
            b_.k_r + sin_ * sin_ * wall * b_.wall_rate + cos_ * cos_ * pole * b_.pole_rate};
  }

  const Bristle<double>& b_;
  double phi_, sin_, cos_, r_;
};

// Minimum of the energy of springs and pole repulsion over 0 < phi <= phi_0, with the tip held at z = z_0.
Equilibrium equilibrium_at_slab(const Bristle<double>& b) {
  const auto tip_at = [&](double phi) { return Equilibrium{b.z_0 / sin(phi), phi}; };
  const auto U = [&](double phi) {
    const Equilibrium e = tip_at(phi);
    return potential_energy(b, {e.r * cos(phi), 0, b.z_0}, b.theta_0, phi);
  };
  constexpr int scan = 64;
  int least = 1;
  double U_least = U(b.phi_0 / scan);
  for (int i = 2; i <= scan; ++i)
    if (const double U_i = U(b.phi_0 * i / scan); U_i < U_least) {
      least = i;
      U_least = U_i;
    }
  const double from = b.phi_0 * (least - 1) / scan, to = b.phi_0 * std::min(least + 1, scan) / scan;
  return tip_at(boost::math::tools::brent_find_minima(U, std::max(from, 1e-6), to, 40).first);
}

}  // namespace

// A minimum of the energy along the balanced radius lies where dU/dphi changes from negative to positive as
// phi increases. The scan finds all such changes that are further apart than its steps.
Equilibrium static_equilibrium(const Bristle<double>& b) {
  constexpr int scan = 64;
  Equilibrium best{};
  double least = std::numeric_limits<double>::infinity(), z = b.z_0;
  const auto bent_at = [&](double phi) {
    const Bent bent(b, phi, z);
    z = std::isnan(bent.z()) ? b.z_0 : bent.z();
    return bent;
  };
  double upper = b.phi_0, at_upper = bent_at(upper).polar().value;
  for (int i = 1; i <= scan; ++i) {
    const double lower = b.phi_0 * (scan - i) / scan, at_lower = bent_at(lower).polar().value;
    if (at_upper >= 0 && at_lower < 0) {
      const double phi = bracketed_root([&](double at) { return bent_at(at).polar(); }, lower, upper,
                                        lower + (upper - lower) * at_lower / (at_lower - at_upper));
      const double r = bent_at(phi).r();
      const Vector3<double> position{r * cos(phi), 0, r * sin(phi)};
      const double U = potential_energy(b, position, b.theta_0, phi);
      if (U < least) {
        least = U;
        best = {r, phi};
      }
    }
    upper = lower;
    at_upper = at_lower;
  }
  if (!std::isfinite(least))
    throw std::runtime_error(fmt::format(
        "no static equilibrium of the bristle under the slab at z_0 = {:.6g}: the wall (lambda_z, beta) is "
        "stronger than the springs (k_r, k_phi)",
        b.z_0));
  return best;
}

// Undeformed radius, and a tip just out of the wall's reach: the springs' only energy is that of bending.
Equilibrium unstretched(const Parameters& p, double z_0) {
  constexpr double clearance = 5;  // in wall ranges lambda_z
  return {1, std::min(asin(std::clamp(z_0 - clearance * p.lambda_z, 0.0, 1.0)), p.phi_0)};
}

Equilibrium initial_state(const Parameters& p, double z_0) {
  const Bristle<double> b = make_bristle(p, z_0, 0);
  switch (p.initial_state) {
    case InitialState::at_slab: return equilibrium_at_slab(b);
    case InitialState::unstretched: return unstretched(p, z_0);
    case InitialState::upright: return {z_0 / sin(p.phi_0), p.phi_0};
    case InitialState::static_equilibrium: break;
  }
  return static_equilibrium(b);
}

State<double> state_at_rest(const Bristle<double>& b, const Equilibrium& e) {
  const double s = e.r * cos(e.phi);
  return {{s * cos(b.theta_0), s * sin(b.theta_0), e.r * sin(e.phi)}, {0, 0, 0}, b.theta_0, e.phi};
}

}  // namespace bristle
