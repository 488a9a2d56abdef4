#include "bristle/ensemble/validity.hpp"
#include "results/variables.hpp"
#include "bristle/model/energy.hpp"
#include "bristle/simd/runner.hpp"
#include "small_result.hpp"

#include "catch.hpp"

#include <fmt/format.h>
#include <set>

namespace bristle::variables_test {
using namespace testing;

namespace {

// A point of a bristle of 2 m at 3 m/s, in which a unit of force is 5 N and neighbours are 0.5 m apart.
PointResult point_in_si() {
  PointResult p = small_point(0);
  p.si = {.length = 2, .velocity = 3, .force = 5, .stress = 5 / 4.0};
  p.parameters.spacing = 0.25;
  p.parameters.L_x = 10;
  return p;
}

Quantity value(const std::string& name, const PointResult& point) {
  Scratch s;
  const Experiment e =
      small_experiment(s, R"(, "model": {"section": "oval"}, "si": {"m_kg": 1, "r0_m": 2, "V0_m_per_s": 3})");
  for (const auto& variable : results::result_variables(e.sweep))
    if (variable.name == name) return variable.of(point);
  throw std::runtime_error(name);
}

}  // namespace

TEST_CASE("variables in SI units, per bristle and per area") {
  const PointResult p = point_in_si();
  const double R_n = p.value[R_N], R_x = p.value[R_X], work = p.value[observable("sliding_work")];
  CHECK(value("R_n_in_N", p).value == Approx(5 * R_n));
  CHECK(value("R_n_in_N", p).error == Approx(5 * p.error[R_N]));
  CHECK(value("z_0_in_m", p).value == Approx(2 * p.z_0));
  CHECK(value("L_x_in_m", p).value == Approx(20));
  CHECK(value("spacing_in_m", p).value == Approx(0.5));
  CHECK(value("tip_travel_in_m", p).value == Approx(2 * p.value[observable("tip_travel")]));
  CHECK(value("hertz_pressure_peak_in_Pa", p).value ==
        Approx(5 / 4.0 * p.value[observable("hertz_pressure_peak")]));
  CHECK(value("bristles_per_m2", p).value == Approx(4));
  CHECK(value("pressure_in_Pa", p).value == Approx(4 * 5 * R_n));
  CHECK(value("friction_in_Pa", p).value == Approx(4 * 5 * R_x));
  CHECK(value("friction_in_Pa", p).error == Approx(4 * 5 * p.error[R_X]));
  CHECK(value("power_in_W_per_m2", p).value == Approx(4 * 5 * 3 * R_x));
  CHECK(value("wear_power_in_W_per_m2", p).value == Approx(4 * 5 * 3 * work));
  CHECK(value("sliding_work_in_J_per_m", p).value == Approx(5 * work));
}

TEST_CASE("impacts per second are those of a passage over its time") {
  PointResult p = point_in_si();
  p.value[observable("impacts")] = 6;
  p.value[N_C_RATIO] = 1.5;
  p.error[observable("impacts")] = 0.6;
  p.error[N_C_RATIO] = 0.15;
  const Quantity rate = value("impacts_per_s", p);
  CHECK(rate.value == Approx(6 / (1.5 * 10 * 2 / 3.0)));  // the slab takes 1.5 L_x/V_0
  CHECK(rate.error == Approx(0.2 * rate.value));
}

TEST_CASE("flags tell where a point is beyond a limit of the model") {
  const auto flags = [](const PointResult& p) {
    std::vector<Exceeds> out;
    for (const ValidityRow& row : kValidity) out.push_back(exceeds(row, p));
    return out;
  };
  PointResult p;
  p.value[R_N] = 2;
  CHECK(flags(p) == std::vector(kValidity.size(), Exceeds::no));
  p.value[observable("hertz_pressure_peak")] = 1.01 * 2 * p.parameters.E_star / M_PI;
  p.value[observable("tip_travel")] = 1.01 * p.parameters.spacing;
  p.value[observable("root_strain")] = 1.01 * p.parameters.strain_limit;
  p.value[observable("stretch_peak")] = 1.01 * p.parameters.stretch_limit;
  p.value[observable("axial_over_euler")] = 4.01;
  p.parameters.pressure_limit = 0.99 * p.value[observable("hertz_pressure_peak")];
  p.value[R_X] = 2.01;
  CHECK(flags(p) == std::vector(kValidity.size(), Exceeds::yes));
  CHECK(flags(without_values(PointStatus::unreachable)) == std::vector(kValidity.size(), Exceeds::unknown));
}

TEST_CASE("a point without a gap has values of its brush alone") {
  // Of the brush and the slab; everything else depends on the gap.
  const std::set<std::string> of_the_brush = {"L_x_in_m", "spacing_in_m", "bristles_per_m2", "lift_off_load",
                                              "lift_off_load_in_N"};
  PointResult p = without_values(PointStatus::unreachable);
  const PointResult inside = point_in_si();
  p.parameters = inside.parameters;
  p.parameters.L_x = 5;
  p.parameters.friction = FrictionLaw::coulomb;
  p.parameters.mu_c = 6;
  p.si = inside.si;
  Scratch s;
  for (const char* bending : {"polar", "rod"}) {
    const Experiment e = small_experiment(
        s,
        fmt::format(
            R"(, "model": {{"section": "oval", "bending": "{}"}}, "load": {{"R_n": 2}}, "si": {{"m_kg": 1, "r0_m": 2, "V0_m_per_s": 3}})",
            bending));
    for (const auto& variable : results::result_variables(e.sweep)) {
      CAPTURE(bending, variable.name);
      CHECK(std::isfinite(variable.of(p).value) == of_the_brush.contains(variable.name));
    }
  }
}

TEST_CASE("an unreachable load: the greatest load that a gap carries, and where") {
  Setup setup;
  setup.parameters.bending = Bending::rod;
  setup.parameters.contact = Contact::hertz;
  setup.orientation.rtol = 0.01;
  const PassageRunner run = make_runner(Engine::fast);
  const PointResult found = solve_point(setup, {.R_n = 100}, run);
  CHECK(found.status == PointStatus::unreachable);
  // No gap carries more, up to the errors and the distance of the gaps.
  double most = 0;
  for (double z_0 = 0.02; z_0 < 0.98; z_0 += 0.03)
    most = std::max(most, solve_point(setup, {.z_0 = z_0}, run).value[R_N]);
  CHECK(found.R_n_largest.value == Approx(most).epsilon(0.03));
  const PointResult there = solve_point(setup, {.z_0 = found.z_0_of_R_n_largest}, run);
  CHECK(there.value[R_N] == Approx(found.R_n_largest.value).margin(found.R_n_largest.error));
  CHECK(std::isnan(there.R_n_largest.value));
}

TEST_CASE("drag is friction and the work of entering bristles, which the slab pays") {
  Setup setup;
  Parameters& p = setup.parameters;
  p.bending = Bending::rod;
  p.contact = Contact::hertz;
  p.friction = FrictionLaw::coulomb;
  p.mu_c = 0.25;
  p.k_r = 100;
  setup.orientation.rtol = 0.01;
  const PointResult found = solve_point(setup, {.z_0 = 0.6}, make_runner(Engine::fast));
  const Equilibrium start = InitialStates(p).at(0.6);
  const Bristle<double> b = make_bristle(p, 0.6, 1);
  const double E_0 = energy(b, state_at_rest(b, start)) / p.L_x;  // the same at each azimuth
  CHECK(found.value[observable("entry_work")] == Approx(E_0).epsilon(1e-6));
  CHECK(drag(found).value == Approx(found.value[R_X] + E_0).epsilon(1e-6));
  CHECK(found.value[observable("axial_over_euler")] ==
        Approx(p.k_r * found.value[observable("compression_peak")] / (0.8225 * p.k_phi)).epsilon(1e-3));
}

TEST_CASE("the contact radius is the tip's where the flag begins") {
  PointResult p;
  const double F_n =
      4 * p.parameters.E_star * p.parameters.R_c * p.parameters.R_c / 3;  // a = R_c in Hertz's a^3
  p.value[observable("hertz_pressure_peak")] = hertz_pressure(p.parameters, F_n);
  CHECK(kValidity[0].excess(p) == Approx(0).margin(1e-12));
}

}  // namespace bristle::variables_test
