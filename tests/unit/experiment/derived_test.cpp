#include "design/design.hpp"
#include "design/statistics.hpp"
#include "bristle/ensemble/point.hpp"
#include "experiment/experiment.hpp"
#include "results/reader.hpp"
#include "bristle/simd/runner.hpp"
#include "scratch.hpp"

#include "catch.hpp"
#include <fmt/format.h>
#include <cmath>

// Experiments that the program derives from a written one, and values that something else replaces.
namespace bristle::derived_test {
using namespace testing;

namespace {

struct Folder {
  Folder() {
    std::filesystem::copy_file(std::string(BRISTLE_EXPERIMENTS) + "/paper.json", s.path("paper.json"));
    s.write("rows.csv", "k_r,tau_f\n10,3e4\n20,2e4\n");
  }
  Experiment load(const std::string& more, const std::vector<std::string>& set = {}) const {
    s.write("e.json", fmt::format(R"({{"extends": "paper.json", "name": "e"{}}})", more));
    return experiment::load_experiment(s.path("e.json"), {set});
  }
  std::string error(const std::string& more, const std::vector<std::string>& set = {}) const {
    return input_error(s, [&] { design::validate_design(load(more, set)); });
  }
  bool valid(const std::string& more, const std::vector<std::string>& set = {}) const {
    design::validate_design(load(more, set));
    return true;
  }
  Scratch s;
};

std::string design(const std::string& variables, const std::string& more = "") {
  return fmt::format(
      R"(, "design": {{"variables": {{{}}}, "objective": {{"minimise": "R_x"}}, "budget": 4{}}})", variables,
      more);
}

const std::string kGap = R"(, "load": {"z_0": 0.6, "R_n": null, "path": null})";

}  // namespace

TEST_CASE("a gap above first contact that the load search finds can be given, and has the same load") {
  const Folder f;
  const std::string soft =
      R"(, "model": {"lambda_z": 0.005}, "orientation": {"sampling": "list", "theta_0_deg": [20, 110]})";
  const auto solved = [&](const std::string& load) {
    const sweep::PointInput input = f.load(soft + R"(, "load": )" + load).sweep.point(0);
    return solve_point(input.setup, input.loading, make_runner(Engine::fast));
  };
  for (const char* target : {"1e-2", "1e-3", "1e-6"}) {
    const PointResult found = solved(fmt::format(R"({{"R_n": {}}})", target));
    REQUIRE(found.status == PointStatus::ok);
    REQUIRE(found.z_0 > std::sin(80 * M_PI / 180));
    const PointResult given = solved(fmt::format(R"({{"R_n": null, "path": null, "z_0": {}}})", found.z_0));
    CHECK(given.status == PointStatus::ok);
    CHECK(given.value[R_N] == Approx(found.value[R_N]).epsilon(2e-3));
  }
  // At the highest gap that is allowed the load vanishes.
  CHECK(solved(R"({"R_n": null, "path": null, "z_0": 1.4848})").value[R_N] < 1e-15);
}

TEST_CASE("the extremes of a design are checked together") {
  const Folder f;
  CHECK_THAT(f.error(R"(, "load": {"R_n": null, "path": null})" +
                     design(R"("phi_0_deg": [50, 85], "z_0": [0.5, 0.9])")),
             Catch::Contains("/design/variables/z_0: 0.9 is above first contact at") &&
                 Catch::Contains("phi_0_deg = 50") &&
                 Catch::Contains("allowed: at most sin(phi_0) + 100 lambda_z = 0.866"));
  CHECK_THAT(f.error(kGap + design(R"("k_r": [5, 9])", R"(, "tolerances": {"phi_0_deg": {"uniform": 0.1}})"),
                     {"/load/z_0=1.06"}),
             Catch::Contains("/load/z_0: 1.06 is above first contact at"));
  CHECK_THAT(f.error(kGap + R"(, "orientation": {"sampling": "lattice", "rows": 100})" +
                     design(R"("spacing": [0.1, 0.2])")),
             Catch::Contains("/design/variables/spacing: cannot vary with \"sampling\": \"lattice\""));
  CHECK_THAT(f.error(kGap + design(R"("A": [1.0001, 1.5])")),
             Catch::Contains("/design/variables/A: 1.0001 has no maximum"));
}

TEST_CASE("values that differ by less than their seven digits are refused") {
  const Folder f;
  CHECK_THAT(
      f.error(kGap + design(R"("k_r": [10, 10.0000001])")),
      Catch::Contains("/design/variables/k_r: the range from 10 to 10.0000001 has 1 value of seven digits"));
  CHECK_THAT(
      f.error(
          R"(, "sweep": {"sample": {"sobol": 8, "seed": 1, "over": {"tau_f": {"uniform": [30000.001, 30000.002]}}}})"),
      Catch::Contains("/sweep/sample/over/tau_f/uniform: the range from 30000.001 to 30000.002 has"));
  CHECK_THAT(
      f.error(
          R"(, "sweep": {"sample": {"sobol": 8, "seed": 1, "over": {"tau_f": {"normal": [30000, 1e-4]}}}})"),
      Catch::Contains("/sweep/sample/over/tau_f/normal: the range from"));
  CHECK_THAT(f.error(kGap + R"(, "model": {"alpha": 0})" +
                     design(R"("k_r": [5, 40])", R"(, "tolerances": {"alpha": {"normal": 0.05}})")),
             Catch::Contains("/design/tolerances/alpha: deviates relative to alpha, which is 0"));
}

TEST_CASE("a value that something else replaces is an error that names it") {
  const Folder f;
  const std::string axis = R"(, "sweep": {"k_r": {"values": [5, 9]}})", k_r = "/model/k_r=7";
  CHECK_THAT(f.error(axis, {k_r}),
             Catch::Contains("--set /model/k_r=7: /model/k_r: has no effect, because /sweep/k_r varies k_r; "
                             "--set /sweep/k_r=null beside it fixes k_r"));
  CHECK(f.valid(axis, {"/sweep/k_r=null", k_r}));
  CHECK_THAT(f.error(R"(, "sweep": {"scatter_r0": {"values": [0, 0.1]}})", {"/scatter/r0/normal=0.05"}),
             Catch::Contains("/scatter/r0: has no effect, because /sweep/scatter_r0 varies r0"));
  CHECK(f.valid(axis, {"/model/k_phi=2"}));
  CHECK(f.valid(R"(, "model": {"k_r": 7})" + axis));  // both in one file
  f.s.write("swept.json",
            R"({"extends": "paper.json", "name": "swept", "sweep": {"k_r": {"values": [5, 9]}}})");
  f.s.write("jumps.json", R"({"extends": "swept.json", "name": "jumps", "locate_jumps": "k_r"})");
  f.s.write("single.json", R"({"extends": "jumps.json", "name": "single", "sweep": {"k_r": null}})");
  CHECK_THAT(
      input_error(f.s, [&] { experiment::load_experiment(f.s.path("single.json"), {}); }),
      Catch::Contains("a file that this one extends asks for these jumps: \"locate_jumps\": null does not"));
  f.s.write("child.json", R"({"extends": "swept.json", "name": "child", "model": {"k_r": 7}})");
  CHECK_THAT(input_error(f.s, [&] { experiment::load_experiment(f.s.path("child.json"), {}); }),
             Catch::Contains("child.json: /model/k_r: has no effect, because /sweep/k_r varies k_r"));
  CHECK_THAT(f.error(R"(, "sweep": {"sample": {"table": "rows.csv"}})", {k_r}),
             Catch::Contains("because /sweep/sample/table varies k_r"));
  CHECK_THAT(
      f.error(R"(, "sweep": {"sample": {"sobol": 8, "seed": 1, "over": {"R_n": {"uniform": [1, 2]}}}})",
              {"/load/R_n=3"}),
      Catch::Contains("/load/R_n: has no effect, because /sweep/sample/over/R_n varies R_n"));
  CHECK_THAT(f.error(R"(, "sweep": {"bending": {"values": ["polar", "rod"]}})", {"/model/bending=rod"}),
             Catch::Contains("/model/bending: has no effect, because /sweep/bending varies bending"));
  CHECK(f.valid(design(R"("k_r": [5, 40])"), {k_r}));  // the start of the search
  CHECK(f.valid(design(R"("k_phi": [1, 4])", R"(, "tolerances": {"k_r": {"normal": 0.05}})"), {k_r}));
  CHECK_THAT(
      f.error(R"(, "model": {"mu_c": 2, "friction": "coulomb"}, "load": {"nominal_friction": 3})"),
      Catch::Contains("/load/nominal_friction: is given, and so is mu_c; both are the strength of friction"));
}

TEST_CASE("the error of a quantile of few values contains the tail that they do not show") {
  std::vector<Quantity> few;
  for (int i = 0; i < 8; ++i) few.push_back({1 + 0.02 * i, 1e-4});
  const Quantity q95 = design::statistic(Statistic::q95, few), q05 = design::statistic(Statistic::q05, few);
  const double deviation = 0.02 * std::sqrt(6.0);
  // The quantile of a normal distribution with this mean and deviation, and its standard error.
  CHECK(q95.value + q95.error > 1.07 + 1.645 * deviation + deviation / std::sqrt(8.0));
  CHECK(q05.value - q05.error < 1.07 - 1.645 * deviation - deviation / std::sqrt(8.0));
  std::vector<Quantity> many;
  for (int i = 0; i < 1024; ++i) many.push_back({std::sin(double(i)), 0});
  CHECK(design::statistic(Statistic::q95, many).error < 0.06);
}

TEST_CASE("a recommended trial is verified by many deviations", "[threads]") {
  const Folder f;
  const Experiment e = f.load(
      kGap + R"(, "orientation": {"sampling": "list", "theta_0_deg": [20, 80, 150]})" +
      R"(, "design": {"variables": {"k_r": [5, 9]}, "tolerances": {"k_r": {"normal": 0.1}}, "budget": 8,
                                  "tolerance_samples": 8, "objective": {"minimise": "R_x", "of": "q95"},
                                  "constraints": [{"variable": "R_x", "max": 100}]})");
  design::run_design(e, {.output = f.s.path("e.h5"), .threads = 2, .quiet = true});
  const results::ResultReader file(f.s.path("e.h5"));
  const auto value = [&](const std::string& name) { return file.variable(name).values.front(); };
  CHECK(value("verification/brushes") == 256);
  CHECK(value("verification/missing") == 0);
  CHECK(value("verification/violated") == 0);
  const double stated = value("best/objective"), error = value("best/objective_err");
  CHECK(std::abs(value("verification/objective") - stated) < 2 * error);
  CHECK(value("verification/objective_err") < error / 2);
}

}  // namespace bristle::derived_test
