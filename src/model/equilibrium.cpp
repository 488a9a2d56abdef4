#include "model/equilibrium.hpp"

#include "model/energy.hpp"

#include <boost/math/tools/roots.hpp>
#include <limits>
#include <stdexcept>

namespace bristle {
namespace {

using boost::math::tools::bisect;
using boost::math::tools::eps_tolerance;

double middle(const std::pair<double, double>& bracket) {
  return bracket.first + (bracket.second - bracket.first) / 2;
}

// r at which the radial forces balance at the elevation phi. The residual rises strictly with r.
double radial_balance(const Bristle<double>& b, double phi) {
  const double sin_phi = sin(phi), cos_phi = cos(phi);
  const auto residual = [&](double r) {
    return b.k_r * (r - 1) + sin_phi * short_range_force(b.z_0 - r * sin_phi, b.wall_peak, b.wall_rate) -
           cos_phi * short_range_force(r * cos_phi, b.axis_peak, b.axis_rate);
  };
  const double longest = 1 + b.axis_peak / b.k_r;
  return middle(bisect(residual, 0.0, longest, eps_tolerance<double>(52)));
}

// dU/dphi along r = radial_balance(phi); zero at an equilibrium.
double polar_residual(const Bristle<double>& b, double phi) {
  const double r = radial_balance(b, phi);
  const double z = r * sin(phi), s = r * cos(phi);
  return b.k_phi * (phi - b.phi_0) + s * short_range_force(b.z_0 - z, b.wall_peak, b.wall_rate) +
         z * short_range_force(s, b.axis_peak, b.axis_rate);
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
      const double phi = middle(bisect(residual, lower, upper, eps_tolerance<double>(50)));
      const double r = radial_balance(b, phi);
      const Vector3<double> position(r * cos(phi), 0, r * sin(phi));
      const double U = potential_energy(b, position, b.theta_0, phi);
      if (U < least) {
        least = U;
        best = {r, phi};
      }
    }
    upper = lower;
    at_upper = at_lower;
  }
  if (!std::isfinite(least)) throw std::runtime_error("no static equilibrium under the slab");
  return best;
}

State<double> state_at_rest(const Bristle<double>& b, const Equilibrium& e) {
  const double s = e.r * cos(e.phi);
  return {{s * cos(b.theta_0), s * sin(b.theta_0), e.r * sin(e.phi)}, {0, 0, 0}, b.theta_0, e.phi};
}

}  // namespace bristle
