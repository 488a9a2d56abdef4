#include "bristle/ensemble/normal_quantile.hpp"
#include "bristle/ensemble/phase.hpp"
#include "compare/comparison.hpp"
#include "compare/reference.hpp"
#include "design/design.hpp"
#include "design/findings.hpp"
#include "design/trials.hpp"
#include "experiment/experiment.hpp"
#include "results/csv.hpp"
#include "results/reader.hpp"
#include "run/task.hpp"
#include "util/error.hpp"
#include "util/file.hpp"
#include "design_folder.hpp"

#include "catch.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

namespace bristle::design_test {

TEST_CASE("design: equal bits for any number of threads, resumed or not, and the second run computes nothing",
          "[threads]") {
  const Folder f;
  const std::string design = R"({"variables": {"k_r": [5, 40], "k_phi": [1.5, 3.5]},
      "tolerances": {"k_r": {"normal": 0.05}, "tau_f": {"uniform": 0.2}}, "tolerance_samples": 2,
      "objective": {"minimise": "R_x", "of": "greatest"}, "budget": 16})";
  const Experiment e = f.load(design, kFew);
  const std::string digest = f.run(e, 1).text("payload_sha256");
  const std::string bytes = read_file(f.s.path("e.h5"));
  f.run(e, 2);
  CHECK(read_file(f.s.path("e.h5")) == bytes);  // up to date: not written again
  // From the journal, of which the last third is lost.
  std::filesystem::remove(f.s.path("e.h5"));
  const std::string journal = read_file(f.s.path("e.h5.journal"));
  f.s.write("e.h5.journal", journal.substr(0, journal.size() * 2 / 3));
  CHECK(f.run(e, 2).text("payload_sha256") == digest);
  const results::ResultReader file(f.s.path("e.h5"));
  CHECK(file.variable("trials/k_r").values.size() == 16 + 1);  // and the start
  CHECK(file.variable("sample").values.size() == 17 * 3);
  CHECK(file.variable("indices/ST").values.size() == 2);
  // The result has all that its points need.
  const Experiment stored = experiment::stored_experiment(file.experiment(), "full", "stored");
  CHECK(stored.sweep.size() == 17 * 3);
}

TEST_CASE("design: only a result with the inputs of the reference is compared with it") {
  const Folder f;
  const std::string design =
      R"({"variables": {"k_r": [5, 60]}, "objective": {"minimise": "R_x"}, "budget": )";
  const auto with_budget = [&](int budget) {
    return f.run(f.load(design + std::to_string(budget) + "}", kFew));
  };
  const auto reference = compare::make_reference(with_budget(6), {});
  CHECK(compare::compare_with_reference(with_budget(6), {}, reference, "reference").points == 6 + 1);
  const compare::Comparison other =
      compare::compare_with_reference(with_budget(8), {}, reference, "reference");
  CHECK(other.agree());
  CHECK_THAT(compare::comparison_text(other), Catch::Contains("0 of 9 points: not compared"));
}

TEST_CASE("design: the margin is the distance to the located jump, on both sides of it", "[threads]") {
  const Folder f;
  const std::string load = R"(, "load": {"R_n": 2}, "orientation": {"rtol": 0.02})";
  const Experiment sweep = experiment::load_experiment(
      f.s.write("sweep.json", R"({"extends": "paper.json", "name": "sweep", "locate_jumps": "k_r",
          "sweep": {"k_r": {"values": [12, 30]}})" +
                                  load + "}"),
      {});
  run::run_experiment(sweep, {.output = f.s.path("sweep.h5"), .quiet = true});
  const results::ResultReader located(f.s.path("sweep.h5"));
  REQUIRE(located.variable("jumps/before").values.size() == 1);
  const double jump = (first(located, "jumps/before") + first(located, "jumps/after")) / 2;
  // Friction is less after the jump.
  const auto place = [&](const char* goal, const char* side, double sign) {
    const auto file =
        f.run(f.load(fmt::format(R"({{"variables": {{"k_r": [12, 30]}}, "objective": {{"{}": "R_x"}},
        "budget": 4}})",
                                 goal),
                     load, goal));
    return first(file, "best/k_r") * (1 + sign * first(file, std::string("margins/margin_") + side));
  };
  CHECK(place("maximise", "above", 1) == Approx(jump).epsilon(0.02));
  CHECK(place("minimise", "below", -1) == Approx(jump).epsilon(0.02));
}

TEST_CASE("design: the recommended trial keeps to the jump margin in its profile, too") {
  // The profile of the trial with the least friction shows a jump at -19.8 %, which its neighbours do not
  // show.
  const Folder f;
  const auto file = f.run(f.load(R"({"variables": {"R_m": [0.0007, 0.0014]}, "budget": 10, "seed": 1,
      "objective": {"minimise": "friction_coefficient"}, "constraints": [{"jump_margin": 0.2}]})",
                                 R"(, "load": {"R_n": null}, "orientation": {"rtol": 0.02},
      "model": {"k_r": null, "k_phi": null, "k_theta": null, "tau_f": null, "R_c": null, "E_star": null, "V_s": null,
                "beta": null, "spacing": null, "L_x": null, "bending": "rod", "contact": "wall"},
      "si": {"m_kg": 1e-4, "r0_m": 0.017, "V0_m_per_s": 10, "E_Pa": 1e8, "nu": 0.4, "R_m": 0.00108, "k_r_over_k_phi": 10,
             "R_c_m": 0.001, "tau_f_Pa": 1e7, "V_s_m_per_s": 0.1, "beta_J": 0.01, "R_n_N": 0.6, "spacing_m": 0.0034,
             "L_x_m": 0.085})"));
  for (const char* side : {"below", "above"})
    CHECK_FALSE(first(file, std::string("margins/margin_") + side) < 0.2);
  CHECK_THAT(summary(file), Catch::Contains("R [mm]") && Catch::Contains("degrees"));
  // One per cent of normal deviations is below -2.326 standard deviations; the drawing has the diameter
  // second.
  const double below = file.variable("drawing/margin_below").values.at(1),
               band = file.variable("drawing/band").values.at(1);
  REQUIRE(std::isnan(file.variable("drawing/margin_above").values.at(1)));
  CHECK(normal_quantile(0.01) * band == Approx(-below).epsilon(1e-4));
  CHECK(std::isnan(file.variable("drawing/band").values.front()));  // the length is no quantity of the design
  const auto& violations = file.variable("trials/violation").values;
  CHECK(violations.at(std::size_t(first(file, "best/trial"))) == 0);
  CHECK(std::ranges::any_of(violations, [](double v) { return v > 0 && v < 0.011; }));  // of the trial before
}

TEST_CASE("design: the recommended brush is rounded to what can be made, and compared with the start") {
  const Folder f;
  const auto file = f.run(f.load(R"({"variables": {"k_r": [5, 40], "k_phi": [1.5, 2.5]}, "budget": 8,
      "objective": {"minimise": "R_x"}, "round_to": {"k_r": 2, "k_phi": 0.25}})",
                                 kFew));
  const std::vector<double> k_r = file.variable("comparison/k_r").values,
                            k_phi = file.variable("comparison/k_phi").values,
                            R_x = file.variable("comparison/objective").values;
  REQUIRE(k_r.size() == 3);  // start, recommended, as made
  CHECK(k_r[0] == 10);
  CHECK(k_phi[0] == 1.9);
  CHECK(k_r[1] == first(file, "best/k_r"));
  CHECK(std::fmod(k_r[2], 2) == 0);
  CHECK(std::fmod(k_phi[2], 0.25) == 0);
  CHECK(std::abs(k_r[2] - k_r[1]) <= 2);
  CHECK(std::abs(k_phi[2] - k_phi[1]) <= 0.25);
  CHECK(R_x[1] < R_x[0]);
  const std::string text = summary(file);
  CHECK_THAT(text, Catch::Contains("rounded to what can be made"));
  CHECK_THAT(text, Catch::Contains("as made"));
}

TEST_CASE("design: objectives that differ from the start's by less than their errors are called so") {
  const Folder f;
  // The length of the slab across the motion has no effect.
  const auto file =
      f.run(f.load(R"({"variables": {"L_y": [4, 6]}, "budget": 4, "objective": {"minimise": "R_x"}})", kFew));
  CHECK_THAT(summary(file),
             Catch::Contains("recommended, the start: L_y = 5") &&
                 Catch::Contains("these variables do not matter here, and the start can be kept"));
  CHECK(first(file, "best/L_y") == 5);
  CHECK(file.variable("best/L_y").values.size() == 1);
}

TEST_CASE("design: few deviations make the values uncertain, not what the variables do") {
  const Folder f;
  // The deviations of tau_f change R_x by more than k_phi does, and every trial has the same three.
  const auto file = f.run(
      f.load(R"({"variables": {"k_phi": [1.89, 1.94]}, "budget": 4, "tolerances": {"tau_f": {"normal": 0.15}},
      "tolerance_samples": 3, "objective": {"minimise": "R_x", "of": "q95"}, "least_gain": 0})",
             kFew));
  const std::vector<double> value = file.variable("comparison/objective").values,
                            error = file.variable("comparison/objective_err").values;
  REQUIRE(value.size() == 2);  // start, recommended
  CHECK(value[1] < value[0]);
  CHECK(value[0] - value[1] < error[0] + error[1]);
  CHECK_THAT(summary(file), Catch::Contains("512 deviations the brush differs from the start") &&
                                !Catch::Contains("do not matter"));
}

TEST_CASE("design: a gain below the least gain keeps the start, and says what the best other brush gains") {
  const Folder f;
  const auto found = [&](const char* least, const std::string& name) {
    return f.run(f.load(fmt::format(R"({{"variables": {{"k_phi": [1.85, 1.95]}}, "budget": 4,
      "objective": {{"minimise": "R_x"}}{}}})",
                                    least),
                        kFew, name));
  };
  const auto kept = found("", "kept"), changed = found(R"(, "least_gain": 0.001)", "changed");
  CHECK(first(kept, "best/k_phi") == 1.9);
  CHECK(kept.variable("best/k_phi").values.size() > 1);  // then the optimum
  const results::Array& brush = kept.variable("comparison/brush");
  REQUIRE(brush.cell(2) == "best_other");
  const double gain = kept.variable("comparison/gain").values[2], start = first(kept, "comparison/objective"),
               other = kept.variable("comparison/objective").values[2];
  CHECK(gain == Approx((start - other) / start));
  CHECK(gain > 0.001);
  CHECK(gain < 0.02);
  CHECK(kept.variable("comparison/gain_err").values[2] < gain);
  CHECK(first(kept, "comparison/gain") == 0);
  CHECK_THAT(summary(kept),
             Catch::Contains("recommended, the start: k_phi = 1.9") &&
                 Catch::Contains("the start is as good: nothing gains 2 % (least_gain), and can be kept") &&
                 Catch::Contains(fmt::format("its gain over the start: {:.2g} +- ", 100 * gain)));
  CHECK(first(changed, "best/k_phi") == kept.variable("comparison/k_phi").values[2]);
  CHECK_THAT(summary(changed), Catch::Contains(fmt::format("  gain over the start: {:.2g} +- ", 100 * gain)));
}

TEST_CASE("design: brushes that cannot carry the load are counted for the recommended brush and the start") {
  const Folder f;
  // Some loads are more than these bristles carry, and soft bristles carry less.
  const auto file =
      f.run(f.load(R"({"variables": {"k_r": [0.4, 1]}, "budget": 4, "tolerances": {"R_n": {"uniform": 0.9}},
      "tolerance_samples": 2, "objective": {"maximise": "R_x", "of": "nominal"}, "least_gain": 0},
      "load": {"R_n": 8}, "model": {"k_r": 0.5})",
                   kFew));
  const std::vector<double>& unloaded = file.variable("verification/unloaded").values;
  REQUIRE(file.variable("verification/brush").cell(1) == "start");
  REQUIRE(first(file, "comparison/k_r") != file.variable("comparison/k_r").values[1]);
  CHECK(unloaded[0] < unloaded[1]);
  CHECK(unloaded[0] > 0);
  const double brushes = first(file, "verification/brushes");
  CHECK_THAT(summary(file), Catch::Contains(fmt::format(
                                " %; {} of {} brushes cannot carry the load; {} of {} of the start's",
                                unloaded[0], brushes, unloaded[1], brushes)));
}

TEST_CASE("design: a recommended brush that violates a constraint as made is said, and fails the command",
          "[threads]") {
  const Folder f;
  // The greatest friction under a limit, which two deviations of each trial keep and 256 do not.
  const Experiment e = f.load(R"({"variables": {"k_phi": [1.5, 2.5]}, "budget": 12,
      "tolerances": {"tau_f": {"normal": 0.1}}, "tolerance_samples": 2,
      "objective": {"maximise": "R_x"}, "constraints": [{"variable": "R_x", "max": 11}]})",
                              kFew);
  const run::RunOptions options{.output = f.s.path("e.h5"), .quiet = true};
  CHECK_FALSE(design::run_design(e, options));
  CHECK_FALSE(design::run_design(e, options));  // up to date
  const results::ResultReader file(f.s.path("e.h5"));
  REQUIRE(file.has("best"));
  CHECK(first(file, "best/constraint_1") <= 11);
  CHECK(file.variable("violated/constraint").cell(0) == "constraint_1");
  CHECK(first(file, "violated/limit") == 11);
  CHECK(first(file, "violated/value") > 11);
  CHECK(first(file, "violated/brushes") == first(file, "verification/violated"));
  CHECK_THAT(summary(file), Catch::Contains(fmt::format(
                                "  VIOLATES R_x <= 11: {:.4g} in the worst case, and {} of {} brushes "
                                "as made are beyond the limit",
                                first(file, "violated/value"), first(file, "violated/brushes"),
                                first(file, "verification/brushes"))));
}

TEST_CASE("design: a start whose brushes violate a constraint is not as good as a brush whose do not",
          "[threads]") {
  const Folder f;
  const auto file = f.run(f.load(R"({"variables": {"k_phi": [1.5, 2.8]}, "budget": 12, "least_gain": 0.9,
      "tolerances": {"tau_f": {"normal": 0.1}}, "tolerance_samples": 2,
      "objective": {"minimise": "R_x"}, "constraints": [{"variable": "R_x", "max": 11}]})",
                                 kFew));
  CHECK(first(file, "best/k_phi") != 1.9);
  const std::vector<double>& violated = file.variable("verification/violated").values;
  REQUIRE(violated.size() == 2);
  CHECK(violated[0] == 0);
  CHECK(violated[1] > 0);
  CHECK_THAT(summary(file), Catch::Contains(fmt::format(
                                "{} of 256 brushes made like the start violate a constraint, and none "
                                "made like this",
                                violated[1])));
}

TEST_CASE("design: a start that is the best trial can be kept, although the variables matter") {
  const Folder f;
  const auto file = f.run(f.load(R"({"variables": {"mu_c": [0.05, 0.2]}, "budget": 8,
      "objective": {"minimise": "R_x"}}, "model": {"friction": "coulomb", "mu_c": 0.05})",
                                 kFew));
  const std::string text = summary(file);
  CHECK_THAT(text, Catch::Contains("the start is as good within the errors, and can be kept"));
  CHECK_THAT(text, !Catch::Contains("do not matter"));
}

TEST_CASE("design: a start that is better than every trial is recommended") {
  const Folder f;
  // The friction of a brush in contact grows with mu_c, and the start has the least in the range.
  const auto file = f.run(f.load(R"({"variables": {"mu_c": [0.05, 0.2]}, "budget": 2,
      "objective": {"minimise": "R_x"}}, "model": {"friction": "coulomb", "mu_c": 0.05})",
                                 kFew));
  CHECK(first(file, "best/mu_c") == 0.05);
  CHECK(first(file, "comparison/mu_c") == 0.05);
  const std::string text = summary(file);
  CHECK_THAT(text, Catch::Contains("2 trials and the start"));
  CHECK_THAT(text, Catch::Contains("recommended, the start: mu_c = 0.05"));
  CHECK_THAT(text, Catch::Contains("no trial is better than the start, which can be kept"));
}

TEST_CASE("design: a start that is worse than the recommended trial is no optimum") {
  const Folder f;
  const auto file = f.run(f.load(R"({"variables": {"mu_c": [0.05, 0.2]}, "budget": 4,
      "objective": {"minimise": "R_x"}}, "model": {"friction": "coulomb", "mu_c": 0.15})",
                                 kFew));
  CHECK(first(file, "best/mu_c") < 0.15);
  for (const double mu_c : file.variable("best/mu_c").values) CHECK(mu_c != 0.15);
}

TEST_CASE("design: the best start is recommended as it is, whatever can be made") {
  const Folder f;
  const auto file =
      f.run(f.load(R"({"variables": {"mu_c": [0.05, 0.2]}, "budget": 2, "round_to": {"mu_c": 0.04},
      "objective": {"minimise": "R_x"}}, "model": {"friction": "coulomb", "mu_c": 0.05})",
                   kFew));
  CHECK_THAT(summary(file), Catch::Contains("recommended, the start: mu_c = 0.05"));
}

TEST_CASE("design: the drawing of bristles that lean one way says which, and has no lift-off load") {
  const Folder f;
  const auto file =
      f.run(f.load(R"({"variables": {"R_m": [0.001, 0.0012]}, "budget": 1,
      "objective": {"minimise": "R_x"}})",
                   R"(, "load": {"R_n": null}, "si": {"m_kg": 1e-4, "r0_m": 0.017, "V0_m_per_s": 10,
      "E_Pa": 1e8, "nu": 0.4, "R_m": 0.00108, "k_r_over_k_phi": 10, "R_c_m": 0.001, "tau_f_Pa": 1e7,
      "V_s_m_per_s": 0.1, "R_n_N": 0.6},
      "orientation": {"distribution": "von_mises", "mean_deg": 30, "concentration": 50, "rtol": 0.1})"));
  const std::string text = summary(file);
  CHECK_THAT(text, Catch::Contains(
                       "bristles lean about 30 degrees from the velocity of the slab (concentration 50)"));
  CHECK_THAT(text, Catch::Contains("at 10 m/s under 0.6") && !Catch::Contains("of its lift-off load"));
  const auto& unit = file.variable("drawing/unit");
  CHECK(unit.cell(0) == "mm");
  CHECK(first(file, "working_range/velocity") == Approx(10));
  CHECK(first(file, "working_range/load") == Approx(0.6).epsilon(0.05));
  CHECK(std::isnan(first(file, "working_range/load_over_lift_off")));
}

TEST_CASE("design: the drawing has every variable, in units for people") {
  const Folder f;
  const auto file = f.run(f.load(
      R"({"variables": {"rho_kg_per_m3": [900, 1500], "spacing_m": [0.0033, 0.0036], "E_Pa": [1.1e8, 1.2e8],
      "k_r_over_k_phi": [9, 11]}, "budget": 1, "objective": {"minimise": "R_x"}})",
      R"(, "load": {"R_n": null}, "si": {"r0_m": 0.017, "V0_m_per_s": 10, "rho_kg_per_m3": 1000, "E_Pa": 1e8,
      "nu": 0.4, "R_m": 0.00108, "k_r_over_k_phi": 10, "R_c_m": 0.001, "tau_f_Pa": 1e7, "V_s_m_per_s": 0.1,
      "R_n_N": 0.6}, "orientation": {"sampling": "list", "theta_0_deg": [20, 80, 150]})"));
  const results::Array& names = file.variable("drawing/dimension");
  std::map<std::string, std::size_t> rows;
  for (std::size_t i = 0; i < names.values.size(); ++i) rows[names.cell(i)] = i;
  CHECK(rows.size() == 9);  // length, diameter, angle, tip, spacing and density, and three variables
  for (const auto& [name, quantity] : {std::pair("rho", "rho_kg_per_m3"), std::pair("E", "E_Pa"),
                                       std::pair("k_r_over_k_phi", "k_r_over_k_phi")})
    CHECK(file.variable("drawing/value").values.at(rows.at(name)) ==
          first(file, std::string("best/") + quantity));
  CHECK(file.variable("drawing/shown").values.at(rows.at("E")) == Approx(first(file, "best/E_Pa") / 1e6));
  CHECK(file.variable("drawing/shown_unit").cell(rows.at("E")) == "MPa");
  CHECK(file.variable("drawing/shown_unit").cell(rows.at("k_r_over_k_phi")) == "1");
  CHECK(file.variable("drawing/shown_unit").cell(rows.at("density")) == "per_cm^2");
  CHECK(file.variable("drawing/meaning").cell(rows.at("rho")) == "density_of_the_shaft");
  CHECK_THAT(summary(file),
             Catch::Contains("density of the shaft") && !Catch::Contains("s.d.: standard deviation"));
}

TEST_CASE("design: a start beyond a constraint is said, with the nearest trial that meets it") {
  const Folder f;
  const auto file = f.run(f.load(R"({"variables": {"mu_c": [0.05, 0.2]}, "budget": 8,
      "objective": {"minimise": "R_x"}, "constraints": [{"variable": "R_x", "min": 0.2}]},
      "model": {"friction": "coulomb", "mu_c": 0.05})",
                                 kFew));
  const std::vector<double> mu_c = file.variable("trials/mu_c").values,
                            violation = file.variable("trials/violation").values;
  double nearest = HUGE_VAL;
  for (std::size_t i = 0; i < mu_c.size(); ++i)
    if (violation[i] == 0) nearest = std::min(nearest, mu_c[i]);
  CHECK(nearest > 0.09);
  CHECK_THAT(summary(file),
             Catch::Contains(fmt::format("the start violates a constraint; the nearest trial that meets the "
                                         "constraints: mu_c = {:.4g}",
                                         nearest)));
}

TEST_CASE("design: trials whose shafts overlap violate a constraint that is always there") {
  const Folder f;
  // The spacing is 0.2, so that shafts thicker than 0.1 overlap; friction does not depend on the radius.
  const auto file = f.run(f.load(R"({"variables": {"R": [0.05, 0.15]}, "budget": 8,
      "objective": {"maximise": "root_strain"}})",
                                 kFew));
  const std::vector<double> R = file.variable("trials/R").values,
                            violation = file.variable("trials/violation").values;
  for (std::size_t i = 0; i < R.size(); ++i) CHECK((violation[i] > 0) == (R[i] > 0.1));
  CHECK(first(file, "best/R") <= 0.1);
  CHECK(first(file, "best/constraint_1") == Approx(0.1 / first(file, "best/R") - 1));
  CHECK_THAT(summary(file), Catch::Contains("clearance >= 0"));
}

TEST_CASE("design: a shaft that is too slender violates the constraint that limits it") {
  const Folder f;
  const auto file = f.run(f.load(R"({"variables": {"R": [0.02, 0.08]}, "budget": 8,
      "objective": {"minimise": "root_strain"}, "constraints": [{"variable": "slenderness", "max": 10}]})",
                                 kFew));
  const std::vector<double> R = file.variable("trials/R").values,
                            violation = file.variable("trials/violation").values;
  for (std::size_t i = 0; i < R.size(); ++i) CHECK((violation[i] > 0) == (R[i] < 0.05));
  CHECK(first(file, "best/R") >= 0.05);
  CHECK(first(file, "best/constraint_1") == Approx(1 / (2 * first(file, "best/R"))));
}

TEST_CASE("design: the trials of two searches are not compared by their numbers") {
  const Folder f;
  const auto searched = [&](int seed) {
    return f.run(f.load(fmt::format(R"({{"variables": {{"k_r": [5, 40]}}, "budget": 4, "seed": {},
        "objective": {{"minimise": "R_x"}}}})",
                                    seed),
                        kFew, fmt::format("seed_{}", seed)));
  };
  const compare::Comparison found = compare::diff_results(searched(1), searched(7), {});
  CHECK_FALSE(found.differences.empty());
  for (const compare::Difference& d : found.differences) CHECK_FALSE(d.name.starts_with("trials/"));
  CHECK(std::ranges::any_of(found.failures, [](const std::string& text) {
    return text.find("not compared, because the coordinates of trial differ") != text.npos;
  }));
}

TEST_CASE("design: a target that no trial meets is not called met") {
  const Folder f;
  const auto text = [&](double value) {
    return summary(f.run(f.load(fmt::format(R"({{"variables": {{"k_r": [5, 40]}}, "budget": 4,
        "objective": {{"target": "R_x", "value": {}}}}})",
                                            value),
                                kFew, fmt::format("target_{}", value))));
  };
  CHECK_THAT(text(-1), Catch::Contains("no trial meets the target"));
  CHECK_THAT(text(-1), Catch::Contains("recommended, trial"));
}

TEST_CASE("design: a trial at which a constraint fails is the nearest miss", "[threads]") {
  const Folder f;
  const Experiment e = f.load(R"({"variables": {"k_r": [5, 40]}, "objective": {"minimise": "R_x"},
      "constraints": [{"variable": "R_x", "max": -1}], "budget": 4})",
                              kFew);
  CHECK_FALSE(design::run_design(e, {.output = f.s.path("e.h5"), .quiet = true}));
  const results::ResultReader file(f.s.path("e.h5"));
  CHECK_FALSE(file.has("best"));
  CHECK(file.variable("trials/violation").values.size() == 4 + 1);
  CHECK_THAT(summary(file), Catch::Contains("the nearest miss is trial"));
}

TEST_CASE("design: a variable without a value at points with values is named, and why") {
  const Folder f;
  // The local friction of a Coulomb law with mu_c = 0.1 is outside the range of the formula.
  const auto text = [&](const char* name, const char* wanted) {
    const auto file = f.run(f.load(fmt::format(R"({{"variables": {{"k_r": [8, 12]}}, "budget": 2, {}}},
        "model": {{"friction": "coulomb", "mu_c": 0.1}})",
                                               wanted),
                                   kFew, name));
    CHECK_FALSE(file.has("best"));
    return summary(file);
  };
  const std::string constraint =
      text("limit", R"("objective": {"minimise": "R_x"}, "constraints": [{"variable": "load_over_lift_off",
          "max": 0.9}])");
  CHECK_THAT(constraint,
             Catch::Contains("  load_over_lift_off has no value in 3 of 3 trials, although their points have "
                             "values: the friction coefficient of rigid bristles at the lift-off load is "
                             "outside 3 to 20") &&
                 Catch::Contains("the lines above say why") && !Catch::Contains("statuses"));
  CHECK_THAT(text("goal", R"("objective": {"minimise": "jump_z_0"})"),
             Catch::Contains("jump_z_0 has no value in 3 of 3 trials, although their points have values: "
                             "R_n(z_0) does not jump across the load"));
}

TEST_CASE("design: trials whose deviations have no value are left out, and the text says so") {
  // These bristles carry 8, but not all the deviations from it, up to 15.
  const Folder f;
  const auto file =
      f.run(f.load(R"({"variables": {"k_r": [0.5, 1]}, "budget": 2, "tolerances": {"R_n": {"uniform": 0.9}},
      "tolerance_samples": 4, "objective": {"minimise": "R_x", "of": "nominal"},
      "constraints": [{"variable": "R_x", "max": 1000}]})",
                   std::string(R"(, "load": {"R_n": 8})") + kFew));
  CHECK_FALSE(file.has("best"));
  CHECK(std::isfinite(first(file, "trials/objective")));
  CHECK(first(file, "trials/missing") < 5);
  CHECK_THAT(summary(file), Catch::Contains("every trial has points without a value"));
}

TEST_CASE(
    "design: a verification leaves out and counts brushes without a value, and those beyond a constraint") {
  const Folder f;
  const Experiment e =
      f.load(R"({"variables": {"k_r": [5, 40]}, "budget": 1, "tolerances": {"k_r": {"uniform": 0.1}},
      "objective": {"minimise": "R_x", "of": "mean"}, "constraints": [{"variable": "R_n", "max": 1}]})",
             std::string(R"(, "sweep": {"V_s": {"values": [0.01, 0.02]}})") + kFew);
  // Of 256 brushes in two scenarios: R_x grows with the brush's number; 10 brushes have no R_x in the second
  // scenario, one has no R_n in the first, and 30, among them the 10, have an R_n beyond the constraint.
  double spread = 0.01;
  const auto solve = [&](const Sweep& sweep, const std::vector<std::size_t>& points, design::Purpose) {
    const auto empty = results::record_of(results::layout_of(sweep), PointResult{}, {});
    std::vector<results::PointRecord> out(points.size(), empty);
    const std::size_t R_x = empty.layout->number("R_x"), R_n = empty.layout->number("R_n"),
                      phase = empty.layout->number("phase"), status = empty.layout->number("status");
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::size_t brush = i / 2, scenario = i % 2;
      out[i].values[R_x] = brush < 10 && scenario == 1 ? NAN : 1000 + spread * double(brush);
      if (brush < 10 && scenario == 1) out[i].values[status] = double(PointStatus::unreachable);
      out[i].values[R_n] = brush == 40 && scenario == 0 ? NAN : brush < 30 ? 2 : 0.5;
      // The brush 100 bounces in one scenario only.
      out[i].values[phase] =
          double(brush < 100 || (brush == 100 && scenario == 0) ? BrushPhase::bouncing : BrushPhase::contact);
    }
    return out;
  };
  const design::Design design = design::read_design(e);
  const design::Verification found = design::Trials(e, design, solve).verify({{"k_r", 10}});
  CHECK(found.brushes == 256);
  CHECK(found.missing == 11);
  CHECK(found.unloaded == 10);
  CHECK(found.violated == 20);
  CHECK(found.beyond.front() == 20);
  CHECK(found.constraints.front() == 2);
  CHECK(found.bouncing == 100 - 11);
  CHECK(found.in_contact == 155);
  CHECK(found.scenario == 1);
  CHECK(found.objective.value == Approx(1000 + 0.01 * (10 + 255) / 2.0).epsilon(1e-9));
  spread = 20;  // the mean of 256 brushes has an error above 1 %
  CHECK(design::Trials(e, design, solve).verify({{"k_r", 10}}).brushes > 256);
}

TEST_CASE("design: the brush's own scatter is the start of a variable and the nominal value of a tolerance") {
  const Folder f;
  const char* scatter = R"(, "scatter": {"r0": {"normal": 0.02}, "bristles": 16})";
  const auto variable = [&](const std::string& more) {
    return f.load(
        R"({"variables": {"scatter_r0": [0.01, 0.05], "k_r": [8, 12]}, "budget": 1, "objective": {"minimise": "R_x"}})",
        more);
  };
  using Start = std::map<std::string, double>;
  CHECK(design::read_design(variable(scatter)).start == Start{{"k_r", 10}, {"scatter_r0", 0.02}});
  CHECK(design::read_design(variable("")).start == Start{{"k_r", 10}, {"scatter_r0", 0}});
  const char* tolerance = R"({"variables": {"k_r": [8, 12]}, "tolerances": {"scatter_r0": {"normal": 0.05}},
      "budget": 1, "objective": {"minimise": "R_x"}})";
  CHECK(design::read_design(f.load(tolerance, scatter)).tolerances.front().nominal == 0.02);
  CHECK_THAT(f.error(tolerance), Catch::Contains("deviates relative to scatter_r0, which is 0") &&
                                     Catch::Contains("give /scatter/r0/normal or /scatter/r0/uniform"));
  CHECK_THAT(f.error(R"({"variables": {"k_r": [8, 12]}, "tolerances": {"E_Pa": {"normal": 0.05}},
      "budget": 1, "objective": {"minimise": "R_x"}})"),
             Catch::Contains("has no nominal value; give /si/E_Pa, or make it a variable"));
}

TEST_CASE("malformed designs: the message names place, value and remedy") {
  const Folder f;
  const auto with = [](const std::string& variables, const std::string& rest = "") {
    return fmt::format(R"({{"variables": {{{}}}, "objective": {{"minimise": "R_x"}}, "budget": 2{}}})",
                       variables, rest);
  };
  CHECK_THAT(f.error(with(R"("k_rr": [1, 2])")),
             Catch::StartsWith("e.json: /design/variables/k_rr: k_rr cannot be swept (did you mean k_r?)"));
  CHECK(f.error(with(R"("k_r": [2, 1])")) ==
        "e.json: /design/variables/k_r: the lower bound 2 is not below the upper bound 1; swap them");
  CHECK_THAT(f.error(with(R"("k_r": [-2, 1])")),
             Catch::Contains("/design/variables/k_r: -2 is out of range for k_r"));
  CHECK(f.error(with("")) ==
        "e.json: /design/variables: {} is not allowed; allowed: an object that is not empty (names of "
        "numbers and their bounds)");
  CHECK(f.error(with(R"("bending": ["polar", "rod"])")) ==
        "e.json: /design/variables/bending/0: \"polar\" is not allowed; allowed: a number");
  CHECK_THAT(f.error(with(R"("friction": [1, 2])")), Catch::Contains("friction is a choice, not a number"));
  CHECK_THAT(f.error(with(R"("k_r": [1, 2])", R"(, "tolerances": {"k_r": {"normal": 0.5}})")),
             Catch::Contains("/design/tolerances/k_r: 0.5 is too wide"));
  CHECK(f.error(with(R"("k_r": [5, 9])", R"(, "round_to": {"k_phi": 1})")) ==
        "e.json: /design/round_to/k_phi: is no variable of the design; allowed: k_r");
  CHECK(f.error(with(R"("k_r": [5, 9])", R"(, "round_to": {"k_r": 20})")) ==
        "e.json: /design/round_to/k_r: 20 has no multiple between the bounds, 5 and 9");
  // 0.6/0.2 and 3e-4/5e-5 are less than 3 and 6 in floating point.
  using Pair = std::pair<double, double>;
  CHECK(design::multiples_within({"mu_c", 0.2, 0.6, false}, 0.2) == Pair(1, 3));
  CHECK(design::multiples_within({"R_m", 1e-4, 3e-4, false}, 5e-5) == Pair(2, 6));
  CHECK(design::multiples_within({"mu_c", 0.55, 0.6, false}, 0.2) == Pair(3, 3));
  CHECK(design::multiples_within({"mean_deg", -60, -10, false}, 20) == Pair(-3, -1));
  CHECK(design::multiples_within({"k_r", 5, 9, false}, 20) == Pair(1, 0));
  CHECK_THAT(f.error(with(R"("k_r": [5, 9])", R"(, "constraints": [{"variable": "strain", "max": 1}])")),
             Catch::Contains("/design/constraints/0/variable: \"strain\" is not a variable of the result"));
  CHECK_THAT(f.error(with(R"("k_r": [5, 9])", R"(, "constraints": [{"variable": "clearence", "min": 1}])")),
             Catch::Contains("(did you mean clearance?); allowed: clearance, slenderness, z_0"));
  CHECK_THAT(f.error(with(R"("k_r": [5, 9])", R"(, "constraints": [{"variable": "R_x"}])")),
             Catch::Contains("gives R_x no limit; add min, max or both"));
  CHECK_THAT(f.error(R"({"variables": {"k_r": [5, 9]}, "objective": {"target": "R_x"}, "budget": 2})"),
             Catch::Contains("/design/objective/value: is missing; target needs it"));
  CHECK_THAT(
      f.error(
          R"({"variables": {"k_r": [5, 9]}, "objective": {"minimise": "R_x", "of": "q95"}, "budget": 2})"),
      Catch::Contains("q95 is over tolerances, and there are none"));
  CHECK_THAT(f.error(with(R"("k_r": [5, 9])"), R"(, "sweep": {"k_r": {"values": [1, 2]}})"),
             Catch::Contains("k_r is varied by the sweep, too"));
  CHECK_THAT(
      f.error(with(R"("k_r": [5, 9])"),
              R"(, "sweep": {"sample": {"sobol": 2, "seed": 1, "over": {"k_phi": {"uniform": [1, 2]}}}})"),
      Catch::Contains("/sweep/sample: the design chooses the points of the sample; remove it"));
  for (const char* analysis : {"sobol_indices", "quantiles"})
    CHECK_THAT(f.error(with(R"("k_r": [5, 9])"), fmt::format(R"(, "analysis": {{"{}": ["R_x"]}})", analysis)),
               Catch::Contains("/analysis: cannot be combined with /design"));
  CHECK_THAT(f.error(with(R"("rows": [1, 5])", R"(, "seed": 1)")), Catch::Contains("rows is an integer"));
  CHECK_THAT(
      f.error(with(R"("k_r": [5, 9])", R"(, "constraints": [{"variable": "R_x", "min": 2, "max": 1}])")),
      Catch::Contains("min 2 is above max 1; swap them"));
  // Deviations and neighbours that the parameter may not have, which would be found after the whole search.
  CHECK_THAT(f.error(with(R"("phi_0_deg": [60, 85])", R"(, "tolerances": {"phi_0_deg": {"uniform": 0.1}})")),
             Catch::Contains("/design/tolerances/phi_0_deg: 93.5 is out of range for phi_0_deg"));
  CHECK_THAT(
      f.error(
          with(R"("k_r": [5, 9])",
               R"(, "tolerances": {"phi_0_deg": {"uniform": 0.01}}, "constraints": [{"jump_margin": 0.2}])")),
      Catch::Contains("/design/tolerances/phi_0_deg: 96 is out of range for phi_0_deg"));
  CHECK_THROWS_WITH(design::run_design(experiment::load_experiment(f.s.path("paper.json"), {}),
                                       {.output = f.s.path("p.h5")}),
                    Catch::Contains("/design: is missing"));
  CHECK_THROWS_WITH(design::run_design(f.load(with(R"("k_r": [5, 9])")),
                                       {.output = f.s.path("p.h5"), .shard = run::Shard{1, 2}}),
                    Catch::Contains("cannot be split into shards"));
}

}  // namespace bristle::design_test
