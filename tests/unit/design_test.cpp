#include "compare/comparison.hpp"
#include "compare/reference.hpp"
#include "design/design.hpp"
#include "design/search.hpp"
#include "design/trials.hpp"
#include "experiment/experiment.hpp"
#include "bristle/model/friction/laws.hpp"
#include "results/csv.hpp"
#include "results/reader.hpp"
#include "run/task.hpp"
#include "util/error.hpp"
#include "util/file.hpp"
#include "scratch.hpp"

#include "catch.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

namespace bristle::design_test {
using namespace testing;
using design::Point;
using design::Score;

namespace {

// The trials of a search of a function, in their order.
template <class Function>
struct Searched {
  explicit Searched(Function function) : of(function) {}
  std::vector<Score> operator()(const std::vector<Point>& more) {
    std::vector<Score> out;
    for (const Point& p : more) {
      points.push_back(p);
      scores.push_back(of(p));
      out.push_back(scores.back());
    }
    return out;
  }
  Function of;
  std::vector<Point> points;
  std::vector<Score> scores;
};

// A folder with the paper's experiment, in which each trial is a few bristles.
struct Folder {
  Folder() {
    std::filesystem::copy_file(std::string(BRISTLE_EXPERIMENTS) + "/paper.json", s.path("paper.json"));
  }
  Experiment load(const std::string& design, const std::string& more = "",
                  const std::string& name = "e") const {
    return experiment::load_experiment(
        s.write(name + ".json", fmt::format(R"({{"extends": "paper.json", "name": "{}", "design": {}{}}})",
                                            name, design, more)),
        {});
  }
  results::ResultReader run(const Experiment& e, int threads = 1) const {
    design::run_design(e, {.output = s.path(e.name + ".h5"), .threads = threads, .quiet = true});
    return results::ResultReader(s.path(e.name + ".h5"));
  }
  std::string error(const std::string& design, const std::string& more = "") const {
    return input_error(
        s, [&] { design::run_design(load(design, more), {.output = s.path("e.h5"), .quiet = true}); });
  }
  Scratch s;
};

constexpr const char* kFew = R"(, "orientation": {"sampling": "list", "theta_0_deg": [20, 80, 150]})";

double first(const results::ResultReader& file, const std::string& name) {
  return file.variable(name).values.front();
}

}  // namespace

TEST_CASE("a front of two objectives: ZDT1") {
  // E. Zitzler, K. Deb, L. Thiele, Evol. Comput. 8(2), 2000: f_2 = 1 - sqrt(f_1) on the front.
  Searched zdt1([](const Point& x) {
    double g = 0;
    for (std::size_t i = 1; i < x.size(); ++i) g += 9 * x[i] / double(x.size() - 1);
    return Score{{x[0], (1 + g) * (1 - std::sqrt(x[0] / (1 + g)))}, 0};
  });
  design::search_front(6, 4000, 1, std::ref(zdt1));
  REQUIRE(zdt1.points.size() == 4000);
  const auto front = design::front_of(zdt1.scores);
  REQUIRE(front.size() > 30);
  double largest_gap = 0, before = 0;
  for (const std::size_t i : front) {
    const auto& f = zdt1.scores[i].objectives;
    CHECK(f[1] - (1 - std::sqrt(f[0])) < 0.02);
    largest_gap = std::max(largest_gap, f[0] - before);
    before = f[0];
  }
  CHECK(std::max(largest_gap, 1 - before) < 0.15);
}

TEST_CASE("a search with twice the budget finds nothing worse") {
  // Bent like a banana, with many minima, and with a jump.
  const std::vector<std::function<double(const Point&)>> functions = {
      [](const Point& x) {
        const double a = 4 * x[0] - 2, b = 4 * x[1] - 1;
        return std::pow(1 - a, 2) + 100 * std::pow(b - a * a, 2);
      },
      [](const Point& x) {
        const double a = x[0] - 0.7, b = x[1] - 0.3;
        return a * a + b * b + 0.05 * (2 - std::cos(20 * a) - std::cos(20 * b));
      },
      [](const Point& x) {
        return x[0] + x[1] < 0.6 ? 0.5 + std::pow(x[0] - 0.2, 2) : 0.2 + std::pow(x[0] - 0.8, 2) + x[1];
      }};
  for (const auto& function : functions)
    for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
      double before = HUGE_VAL;
      for (const std::size_t budget : {15, 30, 60, 120, 240}) {
        Searched trials([&](const Point& x) { return Score{{function(x)}, 0}; });
        const auto minima = design::search_minima(2, budget, seed, std::ref(trials));
        const double least = trials.scores[minima.front()].objectives[0];
        CAPTURE(seed, budget);
        CHECK(least <= before);
        before = least;
      }
    }
}

namespace {

// The area that the front of ZDT1 in two variables dominates, up to 1.2 in both objectives.
double area_of_front(std::size_t budget, std::uint64_t seed) {
  Searched zdt1([](const Point& x) {
    const double g = 1 + 9 * x[1];
    return Score{{x[0], g * (1 - std::sqrt(x[0] / g))}, 0};
  });
  design::search_front(2, budget, seed, std::ref(zdt1));
  const auto front = design::front_of(zdt1.scores);
  double area = 0;
  for (std::size_t i = 0; i < front.size(); ++i) {
    const double next = i + 1 < front.size() ? zdt1.scores[front[i + 1]].objectives[0] : 1.2;
    area += (next - zdt1.scores[front[i]].objectives[0]) *
            std::max(0.0, 1.2 - zdt1.scores[front[i]].objectives[1]);
  }
  return area;
}

}  // namespace

TEST_CASE("a front of two objectives misses less than 5 % of the whole, and less with a larger budget") {
  const double whole = 0.2 + 2.0 / 3 + 0.2 * 1.2;  // the integral of 1.2 - (1 - sqrt(x)), and beyond 1
  constexpr int seeds = 10;
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    double before = 0;
    for (const std::size_t budget : {100, 200, 400}) {
      const double area = area_of_front(budget, seed);
      CAPTURE(seed, budget, area);
      CHECK(area >= before);
      CHECK(area < whole);
      before = area;
    }
    sum += before;
  }
  CHECK(sum / seeds > 0.95 * whole);
}

TEST_CASE("the search of a front keeps to constraints and does without values") {
  // Two opposite objectives; allowed is a disc only, and one half of the square has no values.
  Searched disc([](const Point& x) {
    if (x[1] > 0.6) return Score{{std::nan(""), std::nan("")}, HUGE_VAL};
    const double r = std::hypot(x[0] - 0.5, x[1] - 0.4);
    return Score{{x[0], -x[0]}, std::max(0.0, r - 0.1)};
  });
  design::search_front(2, 600, 3, std::ref(disc));
  const auto front = design::front_of(disc.scores);
  REQUIRE(!front.empty());
  CHECK(disc.scores[front.front()].objectives[0] == Approx(0.4).margin(0.02));
  CHECK(disc.scores[front.back()].objectives[0] == Approx(0.6).margin(0.02));
}

TEST_CASE("the search of one objective finds the minima on both sides of a jump, the best first") {
  Searched jumping([](const Point& x) {
    const double f = x[0] < 0.37 ? 0.5 + 8 * std::pow(x[0] - 0.2, 2) : 0.2 + 3 * std::pow(x[0] - 0.8, 2);
    return Score{{f}, 0};
  });
  const auto minima = design::search_minima(1, 80, 1, std::ref(jumping));
  CHECK(jumping.points.size() <= 80);
  REQUIRE(minima.size() == 2);
  CHECK(jumping.points[minima[0]][0] == Approx(0.8).margin(1e-3));
  CHECK(jumping.points[minima[1]][0] == Approx(0.2).margin(1e-3));
}

TEST_CASE("the search of a target ends where it is met, within the value's error") {
  constexpr double error = 0.01;
  Searched target([](const Point& x) {
    const double f = std::abs(std::abs(x[0] - 0.5) - 0.3);  // met at 0.2 and at 0.8
    return Score{{f}, 0, f <= error / 2};
  });
  const auto met = design::search_minima(1, 400, 1, std::ref(target), true);
  REQUIRE(met.size() >= 2);
  std::vector<double> at;
  for (const std::size_t i : {met[0], met[1]}) {
    CHECK(target.scores[i].is_met);
    at.push_back(target.points[i][0]);
  }
  CHECK(std::abs(at[0] - at[1]) == Approx(0.6).margin(error));
  CHECK(target.points.size() < 120);  // of the budget
}

TEST_CASE("the search of a target goes on with all of the budget if no trial meets it") {
  Searched never([](const Point& x) { return Score{{0.1 + std::pow(x[0] - 0.3, 2)}, 0}; });
  const auto ends = design::search_minima(1, 400, 1, std::ref(never), true);
  CHECK(never.points.size() > 200);
  CHECK(never.points.size() <= 400);
  REQUIRE(!ends.empty());
  CHECK(never.points[ends.front()][0] == Approx(0.3).margin(1e-3));
}

TEST_CASE("a trial whose load another gap carries as well does not meet a target") {
  design::Design design;
  design.objectives = {{Goal::target, "R_x", Statistic::nominal, 0.5}};
  design.tolerance_samples = 0;
  design::Trial trial{{}, {{0.5, 0.01}}, {0}, {}, 0, 0, 0};
  CHECK(design::meets_target(design, trial));
  trial.ambiguous = 1;
  CHECK(!design::meets_target(design, trial));
  design.tolerance_samples = 15;
  CHECK(design::meets_target(design, trial));  // at one deviation
  trial.ambiguous = 8;
  CHECK(!design::meets_target(design, trial));
}

TEST_CASE("a minimum at the edge of a constraint, and a budget of one") {
  Searched edge([](const Point& x) {
    return Score{{x[0] + x[1]}, std::max(0.0, 0.3 - x[0]) + std::max(0.0, 0.25 - x[1])};
  });
  const auto minima = design::search_minima(2, 300, 1, std::ref(edge));
  REQUIRE(edge.scores[minima.front()].violation == 0);
  CHECK(edge.scores[minima.front()].objectives[0] == Approx(0.55).margin(0.01));
  Searched one([](const Point& x) { return Score{{x[0]}, 0}; });
  CHECK(design::search_minima(2, 1, 1, std::ref(one)).size() == 1);
  CHECK(one.points.size() == 1);
  design::search_front(2, 1, 1, std::ref(one));
  CHECK(one.points.size() == 2);
}

TEST_CASE("design: the least friction over k_r is that of a fine sweep") {
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
    REQUIRE(R_x_norm.size() == 12);
    for (std::size_t i = 0; i < R_x_norm.size(); ++i) {
      CHECK(R_x_norm[i] == Approx(chi).margin(error[i]));
      CHECK(error[i] < 1e-3);  // a tenth of rtol: the deviation of the load from its target is part of it
    }
  }
}

TEST_CASE(
    "design: equal bits for any number of threads, resumed or not, and the second run computes nothing") {
  const Folder f;
  const std::string design = R"({"variables": {"k_r": [5, 40], "k_phi": [1.5, 3.5]},
      "tolerances": {"k_r": {"normal": 0.05}, "tau_f": {"uniform": 0.2}}, "tolerance_samples": 2,
      "objectives": [{"minimise": "R_x", "of": "greatest"}, {"maximise": "R_n_fluctuation_or_so"}], "budget": 16})";
  std::string two = design;
  two.replace(two.find("R_n_fluctuation_or_so"), 21, "tip_travel");
  const Experiment e = f.load(two, kFew);
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
  CHECK(file.variable("trials/k_r").values.size() == 16);
  CHECK(file.variable("sample").values.size() == 16 * 3);
  CHECK(file.variable("indices/ST").values.size() == 4);
  CHECK(results::table_of(file, "indices").array("objective").cell(3) == "objective_2");
  // The result has all that its points need.
  const Experiment stored = experiment::stored_experiment(file.experiment(), "full", "stored");
  CHECK(stored.sweep.size() == 48);
}

TEST_CASE("design: only a result with the inputs of the reference is compared with it") {
  const Folder f;
  const std::string design =
      R"({"variables": {"k_r": [5, 60]}, "objectives": [{"minimise": "R_x"}], "budget": )";
  const auto with_budget = [&](int budget) {
    return f.run(f.load(design + std::to_string(budget) + "}", kFew));
  };
  const auto reference = compare::make_reference(with_budget(6), {});
  CHECK(compare::compare_with_reference(with_budget(6), {}, reference, "reference").points == 6);
  const compare::Comparison other =
      compare::compare_with_reference(with_budget(8), {}, reference, "reference");
  CHECK(other.agree());
  CHECK_THAT(compare::comparison_text(other), Catch::Contains("0 of 8 points: not compared"));
}

TEST_CASE("design: the margin is the distance to the located jump, on both sides of it") {
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
        f.run(f.load(fmt::format(R"({{"variables": {{"k_r": [12, 30]}}, "objectives": [{{"{}": "R_x"}}],
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
      "objectives": [{"minimise": "friction_coefficient"}], "constraints": [{"jump_margin": 0.2}]})",
                                 R"(, "load": {"R_n": null}, "orientation": {"rtol": 0.02},
      "model": {"k_r": null, "k_phi": null, "k_theta": null, "tau_f": null, "R_c": null, "E_star": null, "V_s": null,
                "beta": null, "spacing": null, "L_x": null, "bending": "rod", "contact": "wall"},
      "si": {"m_kg": 1e-4, "r0_m": 0.017, "V0_m_per_s": 10, "E_Pa": 1e8, "nu": 0.4, "R_m": 0.00108, "k_r_over_k_phi": 10,
             "R_c_m": 0.001, "tau_f_Pa": 1e7, "V_s_m_per_s": 0.1, "beta_J": 0.01, "R_n_N": 0.6, "spacing_m": 0.0034,
             "L_x_m": 0.085})"));
  for (const char* side : {"below", "above"})
    CHECK_FALSE(first(file, std::string("margins/margin_") + side) < 0.2);
  const auto& violations = file.variable("trials/violation").values;
  CHECK(violations.at(std::size_t(first(file, "best/trial"))) == 0);
  CHECK(std::ranges::any_of(violations, [](double v) { return v > 0 && v < 0.011; }));  // of the trial before
}

TEST_CASE("design: the recommended brush is rounded to what can be made, and compared with the start") {
  const Folder f;
  const auto file = f.run(f.load(R"({"variables": {"k_r": [5, 40], "k_phi": [1.5, 2.5]}, "budget": 8,
      "objectives": [{"minimise": "R_x"}], "round_to": {"k_r": 2, "k_phi": 0.25}})",
                                 kFew));
  const std::vector<double> k_r = file.variable("comparison/k_r").values,
                            k_phi = file.variable("comparison/k_phi").values,
                            R_x = file.variable("comparison/objective_1").values;
  REQUIRE(k_r.size() == 3);  // start, recommended, as made
  CHECK(k_r[0] == 10);
  CHECK(k_phi[0] == 1.9);
  CHECK(k_r[1] == first(file, "best/k_r"));
  CHECK(std::fmod(k_r[2], 2) == 0);
  CHECK(std::fmod(k_phi[2], 0.25) == 0);
  CHECK(std::abs(k_r[2] - k_r[1]) <= 2);
  CHECK(std::abs(k_phi[2] - k_phi[1]) <= 0.25);
  CHECK(R_x[1] < R_x[0]);
  const std::string text = file.provenance().at("design");
  CHECK_THAT(text, Catch::Contains("rounded to what can be made"));
  CHECK_THAT(text, Catch::Contains("as made"));
}

TEST_CASE("design: objectives that differ from the start's by less than their errors are called so") {
  const Folder f;
  // The length of the slab across the motion has no effect.
  const auto file = f.run(
      f.load(R"({"variables": {"L_y": [4, 6]}, "budget": 4, "objectives": [{"minimise": "R_x"}]})", kFew));
  CHECK_THAT(file.provenance().at("design"),
             Catch::Contains("these variables do not matter here, and the start can be kept"));
}

TEST_CASE("design: a start that is the best trial can be kept, although the variables matter") {
  const Folder f;
  const auto file = f.run(f.load(R"({"variables": {"mu_c": [0.05, 0.2]}, "budget": 8,
      "objectives": [{"minimise": "R_x"}]}, "model": {"friction": "coulomb", "mu_c": 0.05})",
                                 kFew));
  const std::string text = file.provenance().at("design");
  CHECK_THAT(text, Catch::Contains("the start is as good within the errors, and can be kept"));
  CHECK_THAT(text, !Catch::Contains("do not matter"));
}

TEST_CASE("design: a start beyond a constraint is said, with the nearest trial that meets it") {
  const Folder f;
  const auto file = f.run(f.load(R"({"variables": {"mu_c": [0.05, 0.2]}, "budget": 8,
      "objectives": [{"minimise": "R_x"}], "constraints": [{"variable": "R_x", "min": 0.2}]},
      "model": {"friction": "coulomb", "mu_c": 0.05})",
                                 kFew));
  const std::vector<double> mu_c = file.variable("trials/mu_c").values,
                            violation = file.variable("trials/violation").values;
  double nearest = HUGE_VAL;
  for (std::size_t i = 0; i < mu_c.size(); ++i)
    if (violation[i] == 0) nearest = std::min(nearest, mu_c[i]);
  CHECK(nearest > 0.09);
  CHECK_THAT(file.provenance().at("design"),
             Catch::Contains(fmt::format("the start violates a constraint; the nearest trial that meets the "
                                         "constraints: mu_c = {:.4g}",
                                         nearest)));
}

TEST_CASE("design: trials whose shafts overlap violate a constraint that is always there") {
  const Folder f;
  // The spacing is 0.2, so that shafts thicker than 0.1 overlap; friction does not depend on the radius.
  const auto file = f.run(f.load(R"({"variables": {"R": [0.05, 0.15]}, "budget": 8,
      "objectives": [{"maximise": "root_strain"}]})",
                                 kFew));
  const std::vector<double> R = file.variable("trials/R").values,
                            violation = file.variable("trials/violation").values;
  for (std::size_t i = 0; i < R.size(); ++i) CHECK((violation[i] > 0) == (R[i] > 0.1));
  CHECK(first(file, "best/R") <= 0.1);
  CHECK(first(file, "best/constraint_1") == Approx(0.1 / first(file, "best/R") - 1));
  CHECK_THAT(file.provenance().at("design"), Catch::Contains("0 <= clearance"));
}

TEST_CASE("design: a target that no trial meets is not called met") {
  const Folder f;
  const auto text = [&](double value) {
    return f
        .run(f.load(fmt::format(R"({{"variables": {{"k_r": [5, 40]}}, "budget": 4,
        "objectives": [{{"target": "R_x", "value": {}}}]}})",
                                value),
                    kFew, fmt::format("target_{}", value)))
        .provenance()
        .at("design");
  };
  CHECK_THAT(text(-1), Catch::Contains("no trial meets the target"));
  CHECK_THAT(text(-1), Catch::Contains("recommended, trial"));
}

TEST_CASE("design: a trial at which a constraint fails is the nearest miss") {
  const Folder f;
  const Experiment e = f.load(R"({"variables": {"k_r": [5, 40]}, "objectives": [{"minimise": "R_x"}],
      "constraints": [{"variable": "R_x", "max": -1}], "budget": 4})",
                              kFew);
  CHECK_FALSE(design::run_design(e, {.output = f.s.path("e.h5"), .quiet = true}));
  const results::ResultReader file(f.s.path("e.h5"));
  CHECK_FALSE(file.has("best"));
  CHECK(file.variable("trials/violation").values.size() == 4);
  CHECK_THAT(file.provenance().at("design"), Catch::Contains("the nearest miss is trial"));
}

TEST_CASE("design: trials whose deviations have no value are left out, and the text says so") {
  // These bristles carry 8, but not all the deviations from it, up to 15.
  const Folder f;
  const auto file =
      f.run(f.load(R"({"variables": {"k_r": [0.5, 1]}, "budget": 2, "tolerances": {"R_n": {"uniform": 0.9}},
      "tolerance_samples": 4, "objectives": [{"minimise": "R_x", "of": "nominal"}],
      "constraints": [{"variable": "R_x", "max": 1000}]})",
                   std::string(R"(, "load": {"R_n": 8})") + kFew));
  CHECK_FALSE(file.has("best"));
  CHECK(std::isfinite(first(file, "trials/objective_1")));
  CHECK(first(file, "trials/missing") < 5);
  CHECK_THAT(file.provenance().at("design"), Catch::Contains("every trial has points without a value"));
}

TEST_CASE(
    "design: a verification leaves out and counts brushes without a value, and those beyond a constraint") {
  const Folder f;
  const Experiment e =
      f.load(R"({"variables": {"k_r": [5, 40]}, "budget": 1, "tolerances": {"k_r": {"uniform": 0.1}},
      "objectives": [{"minimise": "R_x", "of": "mean"}], "constraints": [{"variable": "R_n", "max": 1}]})",
             std::string(R"(, "sweep": {"V_s": {"values": [0.01, 0.02]}})") + kFew);
  // Of 256 brushes in two scenarios: R_x grows with the brush's number; 10 brushes have no R_x in the second
  // scenario, one has no R_n in the first, and 30, among them the 10, have an R_n beyond the constraint.
  double spread = 0.01;
  const auto solve = [&](const Sweep& sweep, const std::vector<std::size_t>& points, design::Purpose) {
    const auto empty = results::record_of(results::layout_of(sweep), PointResult{}, {});
    std::vector<results::PointRecord> out(points.size(), empty);
    const std::size_t R_x = empty.layout->number("R_x"), R_n = empty.layout->number("R_n");
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::size_t brush = i / 2, scenario = i % 2;
      out[i].values[R_x] = brush < 10 && scenario == 1 ? NAN : 1000 + spread * double(brush);
      out[i].values[R_n] = brush == 40 && scenario == 0 ? NAN : brush < 30 ? 2 : 0.5;
    }
    return out;
  };
  const design::Design design = design::read_design(e);
  const design::Verification found = design::Trials(e, design, solve).verify({{"k_r", 10}});
  CHECK(found.brushes == 256);
  CHECK(found.missing == 11);
  CHECK(found.violated == 20);
  CHECK(found.scenarios.front() == 1);
  CHECK(found.objectives.front().value == Approx(1000 + 0.01 * (10 + 255) / 2.0).epsilon(1e-9));
  spread = 20;  // the mean of 256 brushes has an error above 1 %
  CHECK(design::Trials(e, design, solve).verify({{"k_r", 10}}).brushes > 256);
}

TEST_CASE("malformed designs: the message names place, value and remedy") {
  const Folder f;
  const auto with = [](const std::string& variables, const std::string& rest = "") {
    return fmt::format(R"({{"variables": {{{}}}, "objectives": [{{"minimise": "R_x"}}], "budget": 2{}}})",
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
  CHECK_THAT(f.error(with(R"("k_r": [5, 9])", R"(, "constraints": [{"variable": "strain", "max": 1}])")),
             Catch::Contains("/design/constraints/0/variable: \"strain\" is not a variable of the result"));
  CHECK_THAT(f.error(with(R"("k_r": [5, 9])", R"(, "constraints": [{"variable": "R_x"}])")),
             Catch::Contains("gives R_x no limit; add min, max or both"));
  CHECK_THAT(f.error(R"({"variables": {"k_r": [5, 9]}, "objectives": [{"target": "R_x"}], "budget": 2})"),
             Catch::Contains("/design/objectives/0/value: is missing; target needs it"));
  CHECK_THAT(
      f.error(
          R"({"variables": {"k_r": [5, 9]}, "objectives": [{"minimise": "R_x", "of": "q95"}], "budget": 2})"),
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
  CHECK_THAT(f.error(with(R"("k_r": [5, 9])", R"(, "second_model": {"bending": "rod"})"),
                     R"(, "sweep": {"bending": {"values": ["polar", "rod"]}})"),
             Catch::Contains("bending is varied by the sweep, too"));
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
