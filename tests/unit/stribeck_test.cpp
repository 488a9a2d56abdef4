#include "model/friction/laws.hpp"
#include "simd/runner.hpp"

#include "catch.hpp"

namespace bristle::stribeck_test {

namespace {

Parameters stribeck() {
  Parameters p;
  p.friction = FrictionLaw::stribeck;
  p.A = 1.5;
  p.C = 0;
  p.V_s = 0.02;
  return p;
}

double modulation(double V_R) { return Stribeck::modulation(V_R, Stribeck::constants(stribeck())); }

}  // namespace

TEST_CASE("Stribeck friction rises from zero to its static value and falls to the kinetic one") {
  CHECK(modulation(0) == 0);
  CHECK(modulation(1e-9) == Approx(1.5 * 5 * 1e-9 / 0.02).epsilon(1e-6));
  double highest = 0;
  for (double V_R = 0; V_R < 0.1; V_R += 1e-4) highest = std::max(highest, modulation(V_R));
  CHECK(highest > 1.25);
  CHECK(highest < 1.5);
  CHECK(modulation(0.2) == Approx(1).epsilon(1e-3));
  CHECK(modulation(1) < modulation(0.02));
}

TEST_CASE("under Stribeck friction both engines agree, and energy is conserved") {
  const Parameters p = stribeck();
  std::vector<PassageTask> tasks;
  for (const double degrees : {20, 75, 130}) {
    const Bristle<double> b = make_bristle(p, 0.5, degrees * M_PI / 180);
    tasks.push_back({&p, b, static_equilibrium(b), {1e-8, 1e-10}});
  }
  const auto fast = make_runner(Engine::fast)(tasks), reference = make_runner(Engine::reference)(tasks);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    CAPTURE(i);
    CHECK(fast[i].end[FRICTION_X] == Approx(reference[i].end[FRICTION_X]).epsilon(1e-4));
    CHECK(fast[i].gamma_1 == Approx(reference[i].gamma_1).epsilon(1e-4));
    CHECK(fast[i].energy_residual < 1e-5);
  }
}

}  // namespace bristle::stribeck_test
