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

}  // namespace bristle::lift_off_test
