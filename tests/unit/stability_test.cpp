#include "bristle/dynamics/stability.hpp"

#include "bristle/dynamics/trajectory.hpp"
#include "generators.hpp"
#include "bristle/model/lift_off.hpp"

#include "catch.hpp"

namespace bristle::stability_test {
using namespace testing;
using namespace component;

namespace {

Parameters brush(Bending bending, double k_r, double local_friction) {
  Parameters p;
  p.bending = bending;
  p.k_r = k_r;
  p.friction = FrictionLaw::coulomb;
  p.mu_c = local_friction;
  p.C = chi_C_peak_at_V_s(p.A);
  return p;
}

}  // namespace

TEST_CASE("stability: at first contact a bristle oscillates at its own frequency, damped") {
  for (const Bending bending : {Bending::polar, Bending::polar_as_printed, Bending::rod}) {
    Parameters p = brush(bending, 20, 1);
    p.contact = Contact::hertz;
    const SteadySliding s = steady_sliding(p, sin(p.phi_0) + 0.01);
    // Free of the slab, the least damped mode is the radial spring's: it has no damper.
    CHECK(s.in_plane.growth_rate == Approx(0).margin(1e-9));
    CHECK(s.in_plane.frequency == Approx(std::sqrt(20)).epsilon(1e-9));
    // The azimuth, an oscillator with the damping ratio zeta_theta; a rod's has the inertia of its whole
    // length.
    const double k_theta = azimuthal_stiffness(p), lever = bending == Bending::rod ? 1 : cos(p.phi_0);
    const double damping =
        2 * p.zeta_theta * std::sqrt(k_theta) * (bending == Bending::rod ? 1 : cos(p.phi_0));
    if (bending == Bending::polar_as_printed) continue;  // its azimuth turns s^2/r^2 times as far
    CHECK(s.transverse.growth_rate == Approx(-damping / (2 * lever * lever)).epsilon(1e-9));
    CHECK(s.transverse.frequency ==
          Approx(std::sqrt(k_theta / (lever * lever) - std::pow(damping / (2 * lever * lever), 2)))
              .epsilon(1e-9));
  }
}

TEST_CASE("stability: a small disturbance grows as the growth rate says") {
  for (const Bending bending : {Bending::polar, Bending::rod})
    for (const Contact contact : {Contact::wall, Contact::hertz}) {
      Parameters p = brush(bending, 30, 6);
      p.contact = contact;
      p.L_x = 60;  // so long that small disturbances have time to grow
      const double z_0 = 0.5;
      const SteadySliding s = steady_sliding(p, z_0);
      CAPTURE(word(bending), word(contact), s.in_plane.growth_rate, s.in_plane.frequency);
      REQUIRE(s.in_plane.growth_rate > 0.2);
      REQUIRE(s.in_plane.growth_rate < 20);
      IntegratorOptions options;
      options.rtol = 1e-12;
      options.atol = 1e-14;
      options.method = Method::explicit_only;
      const auto b = make_bristle(p, z_0, 0);
      const Trajectory path = record_trajectory({&p, b, {s.r + 1e-9, s.phi}, options});
      // Times between which the distance from rest grows from 1e-8 to 1e-5, by its largest values so far.
      double from = 0, to = 0;
      for (const TrajectoryPoint& point : path.points) {
        const double distance = std::abs(point.y[Z] - s.r * sin(s.phi));
        if (distance > 1e-8 && from == 0) from = point.xi;
        if (distance > 1e-5) {
          to = point.xi;
          break;
        }
      }
      REQUIRE(to > from);
      CHECK(std::log(1e3) / (to - from) == Approx(s.in_plane.growth_rate).epsilon(0.1));
    }
}

TEST_CASE("stability: the tip rests where friction, contact and springs balance") {
  rc::prop("F_n = k_phi gamma/(r (mu sin phi + cos phi)) for polar springs and Coulomb friction", [] {
    const Parameters p = brush(Bending::polar, log_uniform(5, 100), uniform(0.1, 10));
    const double z_0 = uniform(0.3, 0.95);
    const SteadySliding s = steady_sliding(p, z_0);
    if (std::isnan(s.in_plane.growth_rate)) return;
    const double mu = p.mu_c * modulation(p, 1);
    const double F_n = p.k_phi * (p.phi_0 - s.phi) / (s.r * (mu * sin(s.phi) + cos(s.phi)));
    RC_ASSERT(s.F_n == Approx(F_n).epsilon(1e-6));
    RC_ASSERT(p.k_r * (s.r - 1) == Approx(F_n * (mu * cos(s.phi) - sin(s.phi))).epsilon(1e-5).margin(1e-6));
  });
}

}  // namespace bristle::stability_test
