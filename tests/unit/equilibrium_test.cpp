#include "model/equilibrium.hpp"

#include "generators.hpp"

#include <boost/math/tools/roots.hpp>
#include <limits>

namespace bristle::equilibrium_test {
using namespace testing;

namespace {

using boost::math::tools::bisect;
using boost::math::tools::eps_tolerance;

double midpoint(const std::pair<double, double>& bracket) { return (bracket.first + bracket.second) / 2; }

// The equilibria by nested bisections, which need no derivatives: slow, and independent of the program's
// method. Only the division of the range of phi is the same.
double bisected_radius(const Bristle<double>& b, double phi) {
  const auto residual = [&](double r) {
    return b.k_r * (r - 1) + sin(phi) * short_range_force(b.z_0 - r * sin(phi), b.wall_peak, b.wall_rate) -
           cos(phi) * short_range_force(r * cos(phi), b.pole_peak, b.pole_rate);
  };
  if (residual(0) >= 0) return std::numeric_limits<double>::quiet_NaN();
  return midpoint(bisect(residual, 0.0, 1 + b.pole_peak / b.k_r, eps_tolerance<double>(52)));
}

double bisected_residual(const Bristle<double>& b, double phi) {
  const double r = bisected_radius(b, phi), z = r * sin(phi), s = r * cos(phi);
  return b.k_phi * (phi - b.phi_0) + s * short_range_force(b.z_0 - z, b.wall_peak, b.wall_rate) +
         z * short_range_force(s, b.pole_peak, b.pole_rate);
}

double energy_at(const Bristle<double>& b, const Equilibrium& e) {
  return potential_energy(b, Vector3<double>{e.r * cos(e.phi), 0, e.r * sin(e.phi)}, b.theta_0, e.phi);
}

std::vector<Equilibrium> minima(const Bristle<double>& b) {
  constexpr int scan = 64;
  const auto residual = [&](double phi) { return bisected_residual(b, phi); };
  std::vector<Equilibrium> out;
  for (int i = 1; i <= scan; ++i) {
    const double upper = b.phi_0 * (scan - i + 1) / scan, lower = b.phi_0 * (scan - i) / scan;
    if (!(residual(upper) >= 0 && residual(lower) < 0)) continue;
    const double phi = midpoint(bisect(residual, lower, upper, eps_tolerance<double>(50)));
    out.push_back({bisected_radius(b, phi), phi});
  }
  return out;
}

// Parameters far beyond the paper's: soft and stiff bristles, repulsions that are wide or absent.
Parameters any_parameters() {
  Parameters p;
  p.k_r = log_uniform(0.01, 1e4);
  p.k_phi = log_uniform(0.01, 1e3);
  p.phi_0 = uniform(1, 89.99) * M_PI / 180;
  p.lambda = log_uniform(1e-5, 1);
  p.lambda_z = log_uniform(1e-5, 1);
  p.alpha = *rc::gen::arbitrary<bool>() ? log_uniform(1e-4, 1e3) : 0;
  p.beta = log_uniform(1e-4, 1e3);
  return p;
}

// Whether the equilibrium is that of nested bisections with the least energy, or has the same energy as it.
void compare(const Parameters& p, double z_0) {
  const Bristle<double> b = make_bristle(p, z_0, 0);
  Equilibrium best{};
  double least = std::numeric_limits<double>::infinity();
  for (const Equilibrium& e : minima(b))
    if (energy_at(b, e) < least) {
      least = energy_at(b, e);
      best = e;
    }
  if (!std::isfinite(least)) {
    RC_ASSERT_THROWS_AS(static_equilibrium(b), std::runtime_error);
    return;
  }
  const Equilibrium found = static_equilibrium(b);
  // The rounding of z changes the energy of the wall by this share, and that of s the energy of the pole.
  const double rounding = 1e-15 * (1 + b.wall_rate + b.pole_rate);
  RC_ASSERT(std::abs(energy_at(b, found) - least) <= rounding * (least + 1e-3));
  // Where the energy is flat, that error of it moves the minimum by its square root.
  RC_ASSERT(std::abs(found.phi - best.phi) <= 1e-6);
  RC_ASSERT(std::abs(found.r - best.r) <= 1e-6);
}

}  // namespace

TEST_CASE("the static equilibrium is the minimum of least energy that nested bisections find") {
  rc::prop("in the paper's ranges", [] {
    const Parameters p = random_parameters();
    compare(p, uniform(0.01, std::sin(p.phi_0)));
  });
  rc::prop("far beyond them", [] {
    const Parameters p = any_parameters();
    compare(p, uniform(0.01, std::max(0.01, std::sin(p.phi_0))));
  });
}

}  // namespace bristle::equilibrium_test
