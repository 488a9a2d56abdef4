// The search, of functions whose minima are known.
#include "design/design.hpp"
#include "design/search.hpp"
#include "design/trials.hpp"

#include "catch.hpp"
#include <algorithm>
#include <cmath>
#include <functional>

namespace bristle::design_search_test {
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

}  // namespace

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
        Searched trials([&](const Point& x) { return Score{function(x), 0}; });
        const auto minima = design::search_minima(2, budget, seed, std::ref(trials));
        const double least = trials.scores[minima.front()].objective;
        CAPTURE(seed, budget);
        CHECK(least <= before);
        before = least;
      }
    }
}

TEST_CASE("the search finds the minima on both sides of a jump, the best first") {
  Searched jumping([](const Point& x) {
    const double f = x[0] < 0.37 ? 0.5 + 8 * std::pow(x[0] - 0.2, 2) : 0.2 + 3 * std::pow(x[0] - 0.8, 2);
    return Score{f, 0};
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
    return Score{f, 0, f <= error / 2};
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
  Searched never([](const Point& x) { return Score{0.1 + std::pow(x[0] - 0.3, 2), 0}; });
  const auto ends = design::search_minima(1, 400, 1, std::ref(never), true);
  CHECK(never.points.size() > 200);
  CHECK(never.points.size() <= 400);
  REQUIRE(!ends.empty());
  CHECK(never.points[ends.front()][0] == Approx(0.3).margin(1e-3));
}

TEST_CASE("a trial whose load another gap carries as well does not meet a target") {
  design::Design design;
  design.objective = {Goal::target, "R_x", Statistic::nominal, 0.5};
  design.tolerance_samples = 0;
  design::Trial trial;
  trial.objective = {0.5, 0.01};
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
    return Score{x[0] + x[1], std::max(0.0, 0.3 - x[0]) + std::max(0.0, 0.25 - x[1])};
  });
  const auto minima = design::search_minima(2, 300, 1, std::ref(edge));
  REQUIRE(edge.scores[minima.front()].violation == 0);
  CHECK(edge.scores[minima.front()].objective == Approx(0.55).margin(0.01));
  Searched one([](const Point& x) { return Score{x[0], 0}; });
  CHECK(design::search_minima(2, 1, 1, std::ref(one)).size() == 1);
  CHECK(one.points.size() == 1);
}

}  // namespace bristle::design_search_test
