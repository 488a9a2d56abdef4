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
        "lift-off load: 2 (docs/lift-off.md); 1 of 2 bouncing points carry less, 1 of 1 points in contact "
        "carry more\n"
        "lift-off load unknown at 1 point: L_x is outside 5 to 16; a sweep of the load shows where the gap "
        "jumps\n");
  CHECK(text_of({{"phase", {1}},
                 {"R_n", {0.5}},
                 {"R_n_in_N", {0.6}},
                 {"lift_off_load", {1}},
                 {"lift_off_load_in_N", {1.2}},
                 {"load_over_lift_off", {0.5}},
                 {"lift_off_speed", {4}},
                 {"lift_off_speed_err", {2}},
                 {"lift_off_domain", {0}}}) ==
        "phases: 1 bouncing (tips are off the slab for more than half of the time)\n"
        "lift-off load: 1.2 N (docs/lift-off.md); 1 of 1 bouncing points carry less\n"
        "at 0.6 N this brush lifts off above about 4 m/s (between 2.7 and 6)\n");
}

TEST_CASE("phase: the load of a lift-off speed is that of the points at which the speed is known") {
  const double nan = NAN;
  CHECK_THAT(text_of({{"phase", {1, 1}},
                      {"R_n", {0.03, 0.5}},
                      {"R_n_in_N", {0.028, 0.85}},
                      {"lift_off_load", {nan, 1}},
                      {"lift_off_load_in_N", {nan, 1.2}},
                      {"load_over_lift_off", {nan, 0.5}},
                      {"lift_off_speed", {nan, 72}},
                      {"lift_off_speed_err", {nan, 29}},
                      {"lift_off_domain", {double(LiftOffDomain::L_x), 0}}}),
             Catch::Contains("at 0.85 N this brush lifts off above about 72 m/s (between 51 and 100)\n"));
}

TEST_CASE("phase: a line says what there is to control") {
  const auto first_line = [](std::vector<double> R_x) {
    const std::string text =
        text_of({{"phase", {0, 0}}, {"R_n", {2, 2}}, {"R_x", std::move(R_x)}, {"R_x_norm", {0.8, 0.8}}});
    return text.substr(0, text.find('\n'));
  };
  CHECK(first_line({1.6, 4.8}) == "local friction coefficient (R_rigid/R_n): 1 to 3");
  CHECK(first_line({0.32, 4.8}) ==
        "local friction coefficient (R_rigid/R_n): 0.2 to 3; below 0.5 there is nothing to control");
  CHECK(first_line({0.32, NAN}) ==
        "local friction coefficient (R_rigid/R_n): 0.2; a brush then has nearly the friction of rigid "
        "bristles: there is nothing to control (docs/lift-off.md)");
}

}  // namespace bristle::phase_test
