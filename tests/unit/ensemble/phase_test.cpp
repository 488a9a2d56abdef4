#include "bristle/ensemble/phase.hpp"
#include "results/phases.hpp"
#include "bristle/simd/runner.hpp"

#include "catch.hpp"

namespace bristle::phase_test {

TEST_CASE(
    "phase: in contact up to a share of 5 % off the slab, bouncing from a half, unknown without values") {
  PointResult point{};
  const std::vector<std::pair<double, BrushPhase>> rows = {
      {0, BrushPhase::contact},  {0.05, BrushPhase::contact}, {0.06, BrushPhase::mixed},
      {0.49, BrushPhase::mixed}, {0.5, BrushPhase::bouncing}, {1, BrushPhase::bouncing},
      {NAN, BrushPhase::unknown}};
  for (const auto& [share, phase] : rows) {
    CAPTURE(share);
    point.value[observable("off_slab_share")] = share;
    CHECK(phase_of(point) == phase);
  }
}

TEST_CASE("phase: codes that are none, as in a damaged file, are unknown") {
  results::Phases phases;
  phases.add([](const std::string& name) -> std::vector<double> {
    if (name == "phase") return {0, 8, 28, -61, 0.5, NAN, 1};
    if (name == "load_over_lift_off") return {NAN, 1, 1, 1, 1, 1, NAN};
    if (name == "lift_off_domain") return {200, 0, 0, 0, 0, 0, -3};
    return {};
  });
  CHECK(
      phases.text() ==
      "phases: 1 in contact (tips stay on the slab), 1 bouncing (tips are off the slab for more than half of "
      "the time)\n");
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
  const PointResult light = solve_point(setup, {.R_n = 1.2}, run),
                    heavy = solve_point(setup, {.R_n = 2.6}, run);
  CHECK(phase_of(light) == BrushPhase::bouncing);
  CHECK(phase_of(heavy) == BrushPhase::contact);
  CHECK(light.R_x_norm.value < 0.5 * heavy.R_x_norm.value);
}

namespace {

// The text for points with these values by variable.
std::string text_of(const std::map<std::string, std::vector<double>>& values) {
  results::Phases phases;
  phases.add([&](const std::string& name) {
    const auto found = values.find(name);
    return found == values.end() ? std::vector<double>() : found->second;
  });
  return phases.text();
}

}  // namespace

TEST_CASE("phase: a line counts the points of each phase") {
  CHECK(text_of({}) == "");
  CHECK(text_of({{"phase", {3, 3}}}) == "");
  CHECK(text_of({{"phase", {0, 1, 3, 1, 2}}}) ==
        "phases: 1 in contact (tips stay on the slab), 2 bouncing (tips are off the slab for more than half "
        "of the "
        "time), 1 between contact and bouncing\n");
}

TEST_CASE("phase: lines compare loads with the lift-off load, and say why it is unknown") {
  const double nan = NAN;
  CHECK(text_of({{"phase", {1, 1, 0, 0}},
                 {"R_n", {1, 2.1, 2.2, 3}},
                 {"lift_off_load", {2, 2, 2, nan}},
                 {"load_over_lift_off", {0.5, 1.05, 1.1, nan}},
                 {"lift_off_domain", {0, 0, 0, double(LiftOffDomain::L_x)}}}) ==
        "phases: 2 in contact (tips stay on the slab), 2 bouncing (tips are off the slab for more than half "
        "of the "
        "time)\n"
        "lift-off load of point masses: 2 (docs/lift-off.md); 1 of 2 bouncing points carry less, 1 of 1 "
        "points in contact "
        "carry more\n"
        "lift-off load unknown at 1 point: L_x is outside 5 to 16; a sweep of the load shows where the gap "
        "jumps\n");
  CHECK(text_of({{"phase", {1}},
                 {"R_n", {0.5}},
                 {"R_n_in_N", {0.6}},
                 {"lift_off_load", {1}},
                 {"lift_off_load_in_N", {1.2}},
                 {"load_over_lift_off", {0.5}},
                 {"lift_off_domain", {0}}}) ==
        "phases: 1 bouncing (tips are off the slab for more than half of the time)\n"
        "lift-off load of point masses: 1.2 N (docs/lift-off.md); 1 of 1 bouncing points carry less\n");
}

TEST_CASE("phase: scatter does not make a brush bounce whose long bristles stay on the slab") {
  PointResult point{};
  point.value[observable("off_slab_share")] = 0.75;
  point.value[observable("untouched_fraction")] = 0.75;
  CHECK(phase_of(point) == BrushPhase::contact);
  point.value[observable("untouched_fraction")] = 0.4;
  CHECK(phase_of(point) == BrushPhase::bouncing);
  point.value[observable("off_slab_share")] = point.value[observable("untouched_fraction")] = 1;
  CHECK(phase_of(point) == BrushPhase::unknown);
}

TEST_CASE("phase: nothing to control is said where friction is that of rigid bristles in this very result") {
  const auto first_line = [](std::vector<double> R_x_norm) {
    std::vector<double> R_x, R_n(R_x_norm.size(), 2);
    for (const double norm : R_x_norm) R_x.push_back(0.4 * norm * 2);
    const std::string text =
        text_of({{"phase", std::vector<double>(R_n.size(), 0)},
                 {"R_n", R_n},
                 {"lift_off_domain", std::vector(R_n.size(), double(LiftOffDomain::local_friction))},
                 {"load_over_lift_off", std::vector<double>(R_n.size(), NAN)},
                 {"R_x", std::move(R_x)},
                 {"R_x_norm", std::move(R_x_norm)}});
    CHECK_THAT(text, !Catch::Contains("lift-off"));  // nobody expects lift-off at this local friction
    return text.substr(0, text.find('\n'));
  };
  CHECK(first_line({0.317, 0.95}) == "local friction coefficient (R_rigid/R_n): 0.4");
  CHECK(first_line({0.956, 0.99, NAN}) ==
        "local friction coefficient (R_rigid/R_n): 0.4; at every point the brush has 0.95 or more of the "
        "friction of rigid bristles: there is nothing to control");
}

TEST_CASE("phase: an unreachable load is answered by the load that the brush carries") {
  sweep::PointInput asked;
  asked.loading.R_n = 5;
  CHECK(results::carried_text(asked, 2.6321, 0.0123) ==
        "the brush carries at most R_n = 2.63 per bristle (gap 0.0123); you asked for R_n = 5");
  CHECK(results::carried_text(asked, NAN, NAN) == "no gap carries R_n = 5 per bristle");
  CHECK(results::carried_text(asked, 6, 0.01) ==
        "the load does not rise from 0 at first contact, so no gap carries as little as R_n = 5; the brush "
        "carries at most R_n = 6 per bristle (gap 0.01)");
  asked.si = {{"m_kg", 1e-4}, {"r0_m", 0.025}, {"V0_m_per_s", 10}};
  const double unit = 1e-4 * 10 * 10 / 0.025;  // N
  asked.loading.R_n = 0.6 / unit;
  CHECK(results::carried_text(asked, 0.0263 / unit, 0.01) ==
        "the brush carries at most 26.3 mN per bristle (gap 0.25 mm); you asked for 0.6 N");
}

}  // namespace bristle::phase_test
