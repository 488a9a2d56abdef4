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
  const auto file =
      f.run(f.load(R"({"variables": {"k_r": {"log": [5, 60]}}, "objectives": [{"minimise": "R_x"}],
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
  CHECK(first(file, "best/objective_1") <= *least * (1 + 1e-3));
  CHECK(first(file, "best/objective_1") == Approx(*least).epsilon(0.01));
}

namespace {

// Two objectives of a trial or point, the second one as its logarithm.
using Pair = std::array<double, 2>;

// Pairs of the first and the logarithm of the second variable, without those that lack a value.
std::vector<Pair> pairs(const results::ResultReader& file, const std::string& one, const std::string& two) {
  const auto &first = file.variable(one).values, &second = file.variable(two).values;
  std::vector<Pair> out;
  for (std::size_t i = 0; i < first.size(); ++i)
    if (std::isfinite(first[i]) && std::isfinite(second[i])) out.push_back({first[i], std::log(second[i])});
  return out;
}

// The area that these pairs dominate, both to be minimised, up to the corner.
double dominated(std::vector<Pair> all, const Pair& corner) {
  std::erase_if(all, [&](const Pair& pair) { return pair[0] > corner[0] || pair[1] > corner[1]; });
  std::ranges::sort(all);
  double area = 0, height = corner[1];
  for (const Pair& pair : all)
    if (pair[1] < height) {
      area += (corner[0] - pair[0]) * (height - pair[1]);
      height = pair[1];
    }
  return area;
}

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

TEST_CASE("design: the front of friction and peak force misses less than 5 % of a dense sweep's front",
          "[threads]") {
  // A brush that bounces slides easily and strikes hard. Between two jumps lies an island of less than 1 % of
  // the brushes, near k_r = 17 and k_phi = 3.5, which makes a quarter of the area.
  const Folder f;
  const auto dense = pairs(dense_sweep(f), "R_x_norm", "F_n_peak");
  Pair corner = {0, -HUGE_VAL};
  for (const Pair& pair : dense)
    if (std::ranges::none_of(dense, [&](const Pair& other) {
          return other[0] <= pair[0] && other[1] <= pair[1] && other != pair;
        }))
      corner = {std::max(corner[0], pair[0]), std::max(corner[1], pair[1])};
  for (const int seed : {1, 2, 3, 4}) {
    const auto file = f.run(
        f.load(fmt::format(R"({{{}, "objectives": [{{"minimise": "R_x_norm"}}, {{"minimise": "F_n_peak"}}],
            "budget": 640, "seed": {}}})",
                           kVaried, seed),
               kFew, fmt::format("front{}", seed)));
    CAPTURE(seed);
    CHECK(dominated(pairs(file, "trials/objective_1", "trials/objective_2"), corner) >
          0.95 * dominated(dense, corner));
  }
}

TEST_CASE("design: the least friction under a limit of the peak force equals a dense sweep's", "[threads]") {
  const Folder f;
  const auto dense = pairs(dense_sweep(f), "R_x_norm", "F_n_peak");
  double least = HUGE_VAL;
  for (const auto& [R_x_norm, ln_F_n_peak] : dense)
    if (ln_F_n_peak <= std::log(40)) least = std::min(least, R_x_norm);
  const auto file = f.run(f.load(fmt::format(R"({{{}, "objectives": [{{"minimise": "R_x_norm"}}],
      "constraints": [{{"variable": "F_n_peak", "max": 40}}], "budget": 120}})",
                                             kVaried),
                                 kFew));
  CHECK(first(file, "best/objective_1") <= least * (1 + 1e-3));
  CHECK(first(file, "best/objective_1") == Approx(least).epsilon(0.01));
}

TEST_CASE("design: a target of Coulomb friction is its coefficient") {
  const Folder f;
  const auto file =
      f.run(f.load(R"({"variables": {"mu_c": [0.02, 0.2]},
      "objectives": [{"target": "friction_coefficient", "value": 0.13}], "budget": 40})",
                   R"(, "model": {"friction": "coulomb"}, "load": {"R_n": null, "path": null, "z_0": 0.8},
                                       "si": {"m_kg": 0.0001, "r0_m": 0.017, "V0_m_per_s": 10})" +
                       std::string(kFew)));
  CHECK(first(file, "best/objective_1") == Approx(0.13).epsilon(1e-3));
  CHECK(first(file, "best/mu_c") == Approx(0.13).epsilon(0.02));
}

TEST_CASE("design: the largest friction over mu_c of stiff bristles is the plateau") {
  // R_x saturates at 1.55 +- 0.05, as printed and for round rods (k_theta = k_phi).
  const Folder f;
  const auto largest = [&](const std::string& bending) {
    const auto file = f.run(
        f.load(R"({"variables": {"mu_c": {"log": [0.1, 10]}}, "objectives": [{"maximise": "R_x"}],
        "budget": 24})",
               fmt::format(R"(, "orientation": {{"rtol": 0.01}}, "model": {{"friction": "coulomb", "k_r": 50,
            "bending": "{}"}})",
                           bending),
               bending));
    CHECK(first(file, "best/objective_1_err") < 0.02);
    return first(file, "best/objective_1");
  };
  CHECK(largest("polar_as_printed") == Approx(1.55).margin(0.05));
  CHECK(largest("rod") == Approx(1.55).margin(0.05));
}

TEST_CASE("design: with vanishing friction the bristles are rigid") {
  // They stand still, so the modulation of friction is that at the slab's speed: chi = 1.0014.
  const Folder f;
  const Experiment e = f.load(R"({"variables": {"tau_f": {"log": [0.1, 1]}, "k_r": [5, 50]},
      "objectives": [{"minimise": "R_x_norm"}, {"maximise": "R_x_norm"}], "budget": 12})",
                              R"(, "orientation": {"rtol": 0.01})");
  const auto file = f.run(e);
  const double chi = modulation(e.sweep.base.setup.parameters, 1);
  for (const char* objective : {"trials/objective_1", "trials/objective_2"}) {
    const auto &R_x_norm = file.variable(objective).values,
               &error = file.variable(std::string(objective) + "_err").values;
    REQUIRE(R_x_norm.size() == 12);  // the start is outside of the range
    for (std::size_t i = 0; i < R_x_norm.size(); ++i) {
      CHECK(R_x_norm[i] == Approx(chi).margin(error[i]));
      CHECK(error[i] < 1e-3);  // a tenth of rtol: the deviation of the load from its target is part of it
    }
  }
}

}  // namespace bristle::design_test
