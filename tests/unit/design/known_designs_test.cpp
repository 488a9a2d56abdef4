// Designs whose answer is known: from a sweep over all that they vary, or from the physics.
#include "bristle/model/friction/laws.hpp"
#include "design_folder.hpp"

#include "catch.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace bristle::design_test {

TEST_CASE("design: the least friction over k_r equals a fine sweep's", "[threads]") {
  const Folder f;
  const auto file = f.run(f.load(R"({"variables": {"k_r": {"log": [5, 60]}}, "objective": {"minimise": "R_x"},
      "budget": 60})",
                                 kFew));
  const Experiment sweep = experiment::load_experiment(
      f.s.write("sweep.json", fmt::format(R"({{"extends": "paper.json", "name": "sweep",
          "sweep": {{"k_r": {{"logspace": [5, 60, 300]}}}}{}}})",
                                          kFew)),
      {});
  run::run_experiment(sweep, {.output = f.s.path("sweep.h5"), .quiet = true});
  const results::ResultReader fine(f.s.path("sweep.h5"));
  const auto& R_x = fine.variable("R_x").values;
  const auto least = std::ranges::min_element(R_x, [](double a, double b) { return a < b || std::isnan(b); });
  CHECK(first(file, "best/objective") <= *least * (1 + 1e-3));
  CHECK(first(file, "best/objective") == Approx(*least).epsilon(0.01));
}

namespace {

// A dense sweep over the two stiffnesses that a design varies.
constexpr const char* kDense = R"({"k_r": {"logspace": [5, 60, 40]}, "k_phi": {"linspace": [1, 4, 40]}})";
constexpr const char* kVaried = R"("variables": {"k_r": {"log": [5, 60]}, "k_phi": [1, 4]})";

results::ResultReader dense_sweep(const Folder& f) {
  const Experiment sweep = experiment::load_experiment(
      f.s.write("dense.json",
                fmt::format(R"({{"extends": "paper.json", "name": "dense", "sweep": {}{}}})", kDense, kFew)),
      {});
  run::run_experiment(sweep, {.output = f.s.path("dense.h5"), .quiet = true});
  return results::ResultReader(f.s.path("dense.h5"));
}

}  // namespace

TEST_CASE("design: the least friction under a limit of the peak force equals a dense sweep's", "[threads]") {
  const Folder f;
  const results::ResultReader dense = dense_sweep(f);
  const auto &R_x_norm = dense.variable("R_x_norm").values, &F_n_peak = dense.variable("F_n_peak").values;
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < R_x_norm.size(); ++i)
    if (F_n_peak[i] <= 40) least = std::fmin(least, R_x_norm[i]);
  const auto file = f.run(f.load(fmt::format(R"({{{}, "objective": {{"minimise": "R_x_norm"}},
      "constraints": [{{"variable": "F_n_peak", "max": 40}}], "budget": 120}})",
                                             kVaried),
                                 kFew));
  CHECK(first(file, "best/objective") <= least * (1 + 1e-3));
  CHECK(first(file, "best/objective") == Approx(least).epsilon(0.01));
}

TEST_CASE("design: a target of Coulomb friction is its coefficient") {
  const Folder f;
  const auto file =
      f.run(f.load(R"({"variables": {"mu_c": [0.02, 0.2]},
      "objective": {"target": "friction_coefficient", "value": 0.13}, "budget": 40})",
                   R"(, "model": {"friction": "coulomb"}, "load": {"R_n": null, "path": null, "z_0": 0.8},
                                       "si": {"m_kg": 0.0001, "r0_m": 0.017, "V0_m_per_s": 10})" +
                       std::string(kFew)));
  CHECK(first(file, "best/objective") == Approx(0.13).epsilon(1e-3));
  CHECK(first(file, "best/mu_c") == Approx(0.13).epsilon(0.02));
}

TEST_CASE("design: the largest friction over mu_c of stiff bristles is the plateau") {
  // R_x saturates at 1.55 +- 0.05, as printed and for round rods (k_theta = k_phi).
  const Folder f;
  const auto largest = [&](const std::string& bending) {
    const auto file = f.run(
        f.load(R"({"variables": {"mu_c": {"log": [0.1, 10]}}, "objective": {"maximise": "R_x"},
        "budget": 24})",
               fmt::format(R"(, "orientation": {{"rtol": 0.01}}, "model": {{"friction": "coulomb", "k_r": 50,
            "bending": "{}"}})",
                           bending),
               bending));
    CHECK(first(file, "best/objective_err") < 0.02);
    return first(file, "best/objective");
  };
  CHECK(largest("polar_as_printed") == Approx(1.55).margin(0.05));
  CHECK(largest("rod") == Approx(1.55).margin(0.05));
}

TEST_CASE("design: with vanishing friction the bristles are rigid") {
  // They stand still, so the modulation of friction is that at the slab's speed: chi = 1.0014.
  const Folder f;
  const Experiment e = f.load(R"({"variables": {"tau_f": {"log": [0.1, 1]}, "k_r": [5, 50]},
      "objective": {"minimise": "R_x_norm"}, "budget": 12})",
                              R"(, "orientation": {"rtol": 0.01})");
  const auto file = f.run(e);
  const double chi = modulation(e.sweep.base.setup.parameters, 1);
  const auto &R_x_norm = file.variable("trials/objective").values,
             &error = file.variable("trials/objective_err").values;
  REQUIRE(R_x_norm.size() == 12);  // the start is outside of the range
  for (std::size_t i = 0; i < R_x_norm.size(); ++i) {
    CHECK(R_x_norm[i] == Approx(chi).margin(error[i]));
    CHECK(error[i] < 1e-3);  // a tenth of rtol: the deviation of the load from its target is part of it
  }
}

}  // namespace bristle::design_test
