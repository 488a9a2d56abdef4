#include "bristle/model/equilibrium.hpp"

#include "generators.hpp"

#include <boost/math/tools/roots.hpp>
#include <algorithm>
#include <limits>
#include <optional>

namespace bristle::equilibrium_test {
using namespace testing;

namespace {

using boost::math::tools::bisect;
using boost::math::tools::eps_tolerance;

double midpoint(const std::pair<double, double>& bracket) { return (bracket.first + bracket.second) / 2; }

// F_n of the wall, Eq. (3), or of Hertz's contact.
double normal_force(const Bristle<double>& b, double z) {
  if (b.contact == Contact::wall) return short_range_force(b.z_0 - z, b.wall_peak, b.wall_rate);
  return b.hertz_stiffness * std::pow(std::max(0.0, z - b.z_0), 1.5);
}

// The equilibria by nested bisections, which need no derivatives: slow, and independent of the program's
// method.
double bisected_radius(const Bristle<double>& b, double phi) {
  const auto residual = [&](double r) {
    return b.k_r * (r - 1) + sin(phi) * normal_force(b, r * sin(phi)) -
           cos(phi) * short_range_force(r * cos(phi), b.pole_peak, b.pole_rate);
  };
  if (residual(0) >= 0) return std::numeric_limits<double>::quiet_NaN();
  return midpoint(bisect(residual, 0.0, 1 + b.pole_peak / b.k_r, eps_tolerance<double>(52)));
}

double bisected_residual(const Bristle<double>& b, double phi) {
  const double r = bisected_radius(b, phi), z = r * sin(phi), s = r * cos(phi);
  return b.k_phi * (phi - b.phi_0) + s * normal_force(b, z) +
         z * short_range_force(s, b.pole_peak, b.pole_rate);
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

// Parameters far beyond the paper's: soft and stiff bristles, repulsions that are wide or absent. Softer ones
// than k_r = 1 collapse to the base: the minimum that is followed ends at some gap, and others appear
// elsewhere.
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

// The minimum followed from first contact in these steps of the gap: at each gap the one downhill from the
// minimum before, which is below it if the bisected dU/dphi there is positive. None if it ends at some gap.
std::optional<Equilibrium> followed(const Parameters& p, double z_0, double step) {
  Equilibrium e{1, p.phi_0};
  for (double gap = std::sin(p.phi_0);; gap = std::max(z_0, gap - step)) {
    const Bristle<double> b = make_bristle(p, gap, 0);
    const bool down = !(bisected_residual(b, e.phi) < 0);
    std::optional<Equilibrium> next;
    for (const Equilibrium& one : minima(b)) {
      const bool candidate = down ? one.phi <= e.phi : one.phi >= e.phi;
      if (candidate && (!next || std::abs(one.phi - e.phi) < std::abs(next->phi - e.phi))) next = one;
    }
    if (!next) return std::nullopt;
    e = *next;
    if (gap <= z_0) return e;
  }
}

// Whether the equilibrium is one of the minima that nested bisections find, or they find none to follow
// either.
void compare(const Parameters& p, double z_0) {
  const Bristle<double> b = make_bristle(p, z_0, 0);
  const std::vector<Equilibrium> all = minima(b);
  Equilibrium found;
  try {
    found = static_equilibrium(b);
  } catch (const std::runtime_error&) {
    RC_ASSERT(all.empty() || !followed(p, z_0, 1. / 64));
    return;
  }
  // Where the energy is flat, the rounding of the forces moves its minimum by more than their relative
  // rounding.
  RC_ASSERT(all.empty() || std::ranges::any_of(all, [&](const Equilibrium& e) {
              return std::abs(found.phi - e.phi) <= 1e-6 && std::abs(found.r - e.r) <= 1e-6;
            }));
}

double followed_phi(double k_r, double k_phi, double z_0) {
  Parameters p;
  p.k_r = k_r;
  p.k_phi = k_phi;
  return static_equilibrium(make_bristle(p, z_0, 0)).phi;
}

}  // namespace

TEST_CASE("the static equilibrium is a minimum that nested bisections find") {
  rc::prop("in the paper's ranges", [] {
    const Parameters p = random_parameters();
    compare(p, uniform(0.01, std::sin(p.phi_0)));
  });
  SECTION("beyond a gap at which there is none") {
    Parameters p;
    p.k_r = 0.0176;
    p.k_phi = 0.01;
    p.phi_0 = 0.168557;
    p.lambda = 1e-5;
    p.lambda_z = 5.5e-3;
    p.alpha = 1e-4;
    p.beta = 60.6;
    CHECK(minima(make_bristle(p, 0.074, 0)).empty());
    CHECK(!minima(make_bristle(p, 0.0288, 0)).empty());  // compressed to 3e-10 of its length
    CHECK_THROWS_AS(static_equilibrium(make_bristle(p, 0.0288, 0)), std::runtime_error);
  }
  SECTION("at the edge of a range without one") {
    Parameters p;
    p.k_r = 25.433883282219185;
    p.k_phi = 35.782202444161598;
    p.phi_0 = 1.1059418313291296;
    p.lambda = 1e-5;
    p.lambda_z = 0.104602;
    p.alpha = 0;
    p.beta = 84.8856;
    CHECK_THROWS_AS(static_equilibrium(make_bristle(p, 0.24347, 0)), std::runtime_error);
  }
  SECTION("where the wall's force overflows at the height that is tried first") {
    Parameters p;
    p.k_r = p.k_phi = 0.01;
    p.phi_0 = 0.7491388962556248;
    p.lambda = 1e-5;
    p.lambda_z = 1.84191e-05;
    p.alpha = 0;
    p.beta = 1e-4;
    compare(p, 0.15221724352791208);
  }
  rc::prop("far beyond them", [] {
    const Parameters p = any_parameters();
    compare(p, uniform(0.01, std::max(0.01, std::sin(p.phi_0))));
  });
}

TEST_CASE("the static equilibrium is the minimum followed from first contact, not the one of least energy") {
  rc::prop("as nested bisections in finer steps follow it", [] {
    Parameters p = random_parameters();
    p.k_r = log_uniform(1, 30);
    const double z_0 = uniform(0.01, std::sin(p.phi_0));
    const Equilibrium expected = *followed(p, z_0, 1. / 256),
                      found = static_equilibrium(make_bristle(p, z_0, 0));
    RC_ASSERT(std::abs(found.phi - expected.phi) <= 1e-6);
    RC_ASSERT(std::abs(found.r - expected.r) <= 1e-6);
  });
  // Soft bristles are crushed upright at all gaps, stiffer ones bend at all gaps.
  for (const double z_0 : {0.05, 0.1, 0.2}) {
    CAPTURE(z_0);
    CHECK(followed_phi(2, 1.9, z_0) > 1.3);
    CHECK(followed_phi(4.5, 1.9, z_0) > 1.2);
    CHECK(followed_phi(5, 1.9, z_0) < 0.6);
    CHECK(followed_phi(8.5, 3.5, z_0) > 1.2);
    CHECK(followed_phi(9, 3.5, z_0) < 0.6);
  }
}

TEST_CASE("a tip that starts at the slab is there at the angle followed from first contact") {
  Parameters p;
  p.initial_state = InitialState::at_slab;
  for (const double k_r : {2., 4.5, 5., 20.}) {
    p.k_r = k_r;
    const Equilibrium hard = InitialStates(p).at(0.2);
    CAPTURE(k_r);
    CHECK(hard.r * std::sin(hard.phi) == Approx(0.2).epsilon(1e-12));
    // The wall is steep: the equilibrium under it is almost the same.
    CHECK(hard.phi == Approx(static_equilibrium(make_bristle(p, 0.2, 0)).phi).margin(0.02));
  }
}

TEST_CASE("initial states at several gaps, in any order, are those computed at each gap alone, bit for bit") {
  rc::prop("under both rules of the initial state", [] {
    Parameters p = random_parameters();
    p.initial_state = *rc::gen::element(InitialState::static_equilibrium, InitialState::at_slab);
    InitialStates common(p);
    for (int i = 0; i < 5; ++i) {
      const double z_0 = uniform(0.01, std::sin(p.phi_0));
      const Equilibrium one = common.at(z_0), alone = InitialStates(p).at(z_0);
      RC_ASSERT(one.r == alone.r);
      RC_ASSERT(one.phi == alone.phi);
    }
  });
}

}  // namespace bristle::equilibrium_test
