#include "model/equilibrium.hpp"

#include "model/energy.hpp"

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/roots.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>

namespace bristle {
namespace {

using boost::math::tools::bisect;
using boost::math::tools::eps_tolerance;

double midpoint(const std::pair<double, double>& bracket) {
  return bracket.first + (bracket.second - bracket.first) / 2;
}

// r at which the radial forces balance for the polar angle phi. The residual increases strictly with r. NaN
// if it is positive at r = 0: then the wall, reaching that far, compresses the spring completely.
double balanced_radius(const Bristle<double>& b, double phi) {
  const double sin_phi = sin(phi), cos_phi = cos(phi);
  const auto residual = [&](double r) {
    return b.k_r * (r - 1) + sin_phi * short_range_force(b.z_0 - r * sin_phi, b.wall_peak, b.wall_rate) -
           cos_phi * short_range_force(r * cos_phi, b.pole_peak, b.pole_rate);
  };
  if (residual(0) >= 0) return std::numeric_limits<double>::quiet_NaN();
  const double r_max = 1 + b.pole_peak / b.k_r;
  return midpoint(bisect(residual, 0.0, r_max, eps_tolerance<double>(52)));
}

// dU/dphi along r = balanced_radius(phi); zero at an equilibrium.
double polar_residual(const Bristle<double>& b, double phi) {
  const double r = balanced_radius(b, phi);
  const double z = r * sin(phi), s = r * cos(phi);
  return b.k_phi * (phi - b.phi_0) + s * short_range_force(b.z_0 - z, b.wall_peak, b.wall_rate) +
         z * short_range_force(s, b.pole_peak, b.pole_rate);
}

// Minimum of the energy of springs and pole repulsion over 0 < phi <= phi_0, with the tip held at z = z_0.
Equilibrium equilibrium_at_slab(const Bristle<double>& b) {
  const auto tip_at = [&](double phi) { return Equilibrium{b.z_0 / sin(phi), phi}; };
  const auto U = [&](double phi) {
    const Equilibrium e = tip_at(phi);
    return potential_energy(b, {e.r * cos(phi), 0, b.z_0}, b.theta_0, phi);
  };
  constexpr int scan = 64;
  int least = 1;
  for (int i = 2; i <= scan; ++i)
    if (U(b.phi_0 * i / scan) < U(b.phi_0 * least / scan)) least = i;
  const double from = b.phi_0 * (least - 1) / scan, to = b.phi_0 * std::min(least + 1, scan) / scan;
  return tip_at(boost::math::tools::brent_find_minima(U, std::max(from, 1e-6), to, 40).first);
}

}  // namespace

Equilibrium static_equilibrium(const Bristle<double>& b) {
  constexpr int scan = 64;
  const auto residual = [&](double phi) { return polar_residual(b, phi); };
  Equilibrium best{};
  double least = std::numeric_limits<double>::infinity();
  double upper = b.phi_0, at_upper = residual(upper);
  for (int i = 1; i <= scan; ++i) {
    const double lower = b.phi_0 * (scan - i) / scan, at_lower = residual(lower);
    if (at_upper >= 0 && at_lower < 0) {  // a minimum of the energy, not a maximum
      const double phi = midpoint(bisect(residual, lower, upper, eps_tolerance<double>(50)));
      const double r = balanced_radius(b, phi);
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

Equilibrium initial_state(const Parameters& p, double z_0) {
  const Bristle<double> b = make_bristle(p, z_0, 0);
  switch (p.initial_state) {
    case InitialState::at_slab: return equilibrium_at_slab(b);
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
