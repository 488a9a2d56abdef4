// What every registered friction law has to fulfil.
#include "catch.hpp"
#include "bristle/model/friction/laws.hpp"
#include "bristle/model/friction/table.hpp"
#include "bristle/simd/runner.hpp"

namespace bristle::friction_test {

namespace {

Parameters with_friction(int law) {
  Parameters p;
  p.friction = FrictionLaw(law);
  p.A = 1.5;
  p.C = chi_C_peak_at_V_s(p.A);
  p.V_s = 0.02;
  static const auto table = modulation_table({{0, p.V_s, 5 * p.V_s, 1}, {0, p.A, 1, 1}});
  p.custom_friction.table = table.get();
  return p;
}

}  // namespace

TEST_CASE("every friction law: the modulation rises from zero to its static value and falls to 1") {
  for (int law = 0; law < int(FrictionLaw::count); ++law) {
    const Parameters p = with_friction(law);
    CAPTURE(word(p.friction));
    CHECK(modulation(p, 0) == 0);
    const double slope = modulation(p, 1e-9) / 1e-9;
    CHECK(slope > 1 / p.V_s);
    CHECK(modulation(p, 2e-9) == Approx(2e-9 * slope).epsilon(1e-6));
    double highest = 0;
    for (double V_R = 0; V_R < 0.1; V_R += 1e-4) highest = std::max(highest, modulation(p, V_R));
    CHECK(highest > 1 + (p.A - 1) / 2);
    // The table of a law of one's own rounds corners by up to 1e-4 of the largest mu.
    CHECK(highest < p.A * (1 + (p.friction == FrictionLaw::custom ? 1e-4 : 1e-9)));
    CHECK(modulation(p, 20 * p.V_s) == Approx(1).epsilon(0.05));
    CHECK(modulation(p, 1) == Approx(1).epsilon(0.01));
  }
}

TEST_CASE("every friction law: the table has its modulation") {
  for (int law = 0; law < int(FrictionLaw::count); ++law) {
    const Parameters p = with_friction(law);
    CAPTURE(word(p.friction));
    const Bristle<double> b = make_bristle(p, 0.6, 0);
    const ModulationTable table(p.friction, b.friction_constants);
    for (const double V_R : {0.0, 1e-6, 0.003, 0.01, 0.2, 1.0, 30.0, 1e20})
      CHECK(table.at(V_R / b.V_scale) == Approx(modulation(p, V_R)).margin(1e-9));
  }
}

TEST_CASE("every friction law: both engines agree, and energy is conserved") {
  for (int law = 0; law < int(FrictionLaw::count); ++law) {
    const Parameters p = with_friction(law);
    CAPTURE(word(p.friction));
    std::vector<PassageTask> tasks;
    for (const double degrees : {20, 75, 130}) {
      const Bristle<double> b = make_bristle(p, 0.5, degrees * M_PI / 180);
      tasks.push_back({&p, b, static_equilibrium(b), {1e-8, 1e-10}});
    }
    const auto fast = make_runner(Engine::fast)(tasks), reference = make_runner(Engine::reference)(tasks);
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      CAPTURE(i);
      CHECK(fast[i].end[component::FRICTION_X] ==
            Approx(reference[i].end[component::FRICTION_X]).epsilon(1e-4));
      CHECK(fast[i].gamma_1 == Approx(reference[i].gamma_1).epsilon(1e-4));
      CHECK(fast[i].energy_residual < 1e-5);
    }
  }
}

}  // namespace bristle::friction_test
