#include "ensemble/phase.hpp"
#include "results/phases.hpp"
#include "simd/runner.hpp"

#include "catch.hpp"

namespace bristle::phase_test {

TEST_CASE("phase: in contact up to a share of 5 % off the slab, bouncing from a half, unknown without values") {
  PointResult point{};
  const std::vector<std::pair<double, BrushPhase>> rows = {{0, BrushPhase::contact},   {0.05, BrushPhase::contact},
                                                           {0.06, BrushPhase::mixed},  {0.49, BrushPhase::mixed},
                                                           {0.5, BrushPhase::bouncing}, {1, BrushPhase::bouncing},
                                                           {NAN, BrushPhase::unknown}};
  for (const auto& [share, phase] : rows) {
    CAPTURE(share);
    point.value[observable("off_slab_share")] = share;
    CHECK(phase_of(point) == phase);
  }
}

TEST_CASE("phase: one brush bounces under a load and stays in contact under a greater one") {
  Setup setup;
  Parameters& p = setup.parameters;
  p.bending = Bending::rod;
  p.contact = Contact::hertz;
  p.k_r = 20;
  p.C = chi_C_peak_at_V_s(p.A);
  setup.orientation.rtol = 0.02;
  const PassageRunner run = make_runner(Engine::fast);
  const PointResult light = solve_point(setup, {.R_n = 1.2}, run), heavy = solve_point(setup, {.R_n = 2.6}, run);
  CHECK(phase_of(light) == BrushPhase::bouncing);
  CHECK(phase_of(heavy) == BrushPhase::contact);
  CHECK(light.R_x_norm < 0.5 * heavy.R_x_norm);
}

TEST_CASE("phase: a line counts the points of each phase") {
  CHECK(results::phase_text({}) == "");
  CHECK(results::phase_text({3, 3}) == "");
  CHECK(results::phase_text({0, 1, 3, 1, 2}) ==
        "phases: 1 in contact (tips stay on the slab), 2 bouncing (tips are off the slab for more than half of the "
        "time), 1 between the two\n");
}

}  // namespace bristle::phase_test
