#include "bristle/model/lift_off.hpp"

#include "generators.hpp"

namespace bristle::lift_off_test {
using namespace testing;

namespace {

// The paper's rods, round, under Coulomb friction of this local friction coefficient.
Parameters rods(double k_r, double k_phi, double mu_c = 6) {
  Parameters p;
  p.bending = Bending::rod;
  p.friction = FrictionLaw::coulomb;
  p.mu_c = mu_c;
  p.k_r = k_r;
  p.k_phi = k_phi;
  return p;
}

// The same bristles where the slab is this many times as fast, and a load that is the same in newtons.
Parameters faster(Parameters p, double speed) {
  for (double* stiffness : {&p.k_r, &p.k_phi, &p.k_theta, &p.E_star, &p.tau_f}) *stiffness /= speed * speed;
  return p;
}

}  // namespace

TEST_CASE("lift-off: the load by the formula, and none outside the range of its tests") {
  CHECK(lift_off_load(rods(20, 1.9)) == Approx(0.346 * std::sqrt(38.) - 0.154 * 1.9 * std::log(1.9)));
  CHECK(lift_off_load(rods(10, 1)) == Approx(0.346 * std::sqrt(10.)));
  const std::pair<Parameters, LiftOffDomain> outside[] = {{rods(5, 1.9), LiftOffDomain::k_r_over_k_phi},
                                                          {rods(100, 1.9), LiftOffDomain::k_r_over_k_phi},
                                                          {rods(3, 0.3), LiftOffDomain::k_phi},
                                                          {rods(20, 1.9, 1), LiftOffDomain::local_friction},
                                                          {rods(20, 1.9, 40), LiftOffDomain::local_friction},
                                                          {rods(40, 9), LiftOffDomain::load_over_k_phi}};
  for (const auto& [p, domain] : outside) {
    CAPTURE(p.k_r, p.k_phi, p.mu_c);
    CHECK(std::isnan(lift_off_load(p)));
    CHECK(lift_off_domain(p) == domain);
    CHECK(outside_of(domain).find(" is outside ") != std::string::npos);
  }
  Parameters p = rods(20, 1.9);
  CHECK(outside_of(lift_off_domain(p)) == "");
  p.L_x = 3;
  CHECK(outside_of(lift_off_domain(p)) == "L_x is outside 5 to 16");
  p = rods(20, 1.9);
  p.section = Section::oval;
  CHECK(outside_of(lift_off_domain(p)) == "rods are oval");
}

TEST_CASE("lift-off: at the lift-off speed the load is the lift-off load, and above it the brush bounces") {
  rc::prop("for random brushes", [] {
    const Parameters p = rods(uniform(8, 25), uniform(0.8, 3), 8);
    const double R_n = uniform(0.8, 1.2) * lift_off_load(p);
    RC_PRE(std::isfinite(R_n));
    const LiftOffSpeed speed = lift_off_speed(p, R_n);
    RC_PRE(std::isfinite(speed.value));
    const auto ratio = [&](double times) { return R_n / (times * times) / lift_off_load(faster(p, times)); };
    RC_ASSERT(ratio(speed.value) == Approx(1).epsilon(1e-9));
    // A faster slab may leave the range of the tests, in which there is a lift-off load.
    const double above = ratio(1.01 * speed.value);
    RC_ASSERT(above < 1 || lift_off_domain(faster(p, 1.01 * speed.value)) != LiftOffDomain::tested);
    // The scatter of the load is the factor of the speed.
    const LiftOffSpeed heavier = lift_off_speed(p, R_n * (1 + kLiftOff.scatter));
    if (std::isfinite(heavier.value))
      RC_ASSERT(heavier.value / speed.value == Approx(speed.factor).epsilon(1e-9));
  });
}

TEST_CASE("lift-off: statics of bouncing bristles") {
  // Independent values of the mean over theta_0 of the integral of z_0 (1/r - 1), by the trapezoidal rule.
  for (const auto& [z_0, b] : {std::pair{0.35, 0.0863}, {0.43, 0.0850}, {0.55, 0.0738}}) {
    const Parameters soft = rods(1e-9, 2), stiff = rods(5, 1e-9);
    CHECK(bouncing_load_by_statics(stiff, z_0) * stiff.L_x / 5 == Approx(b).epsilon(2e-3));
    const double phi = std::asin(z_0);
    CHECK(bouncing_load_by_statics(soft, z_0) ==
          Approx(2 * (soft.phi_0 - phi) / std::cos(phi)).epsilon(1e-9));
  }
}

}  // namespace bristle::lift_off_test
