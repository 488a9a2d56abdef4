#include "checks/checks.hpp"
#include "experiment/input_error.hpp"
#include "results/writer.hpp"
#include "scratch.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace bristle;
using namespace bristle::testing;

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
using Curve = std::vector<Curves::Point>;

Curve curve(const std::vector<double>& values, double error) {
  Curve c;
  for (const double v : values) c.push_back({v, error});
  return c;
}

// A result whose R_x_norm over k_r is what the test says, with these checks.
std::vector<CheckResult> verdicts(const Scratch& s, const std::vector<double>& values, double error,
                                  const std::string& check) {
  s.write("paper.json", bytes_of(std::string(BRISTLE_EXPERIMENTS) + "/paper.json"));
  const Experiment e = load_experiment(
      s.write("c.json", R"({"extends": "paper.json", "name": "c", "sweep": {"k_r": {"linspace": [1, 10, )" +
                            std::to_string(values.size()) +
                            R"(]}}, "checks": [{"claim": "x", "statement": "y",
        "variable": "R_x_norm", "along": "k_r", )" +
                            check + "}]}"),
      {});
  ResultWriter writer(e, s.path("c.h5"));
  for (std::size_t i = 0; i < values.size(); ++i) {
    PointResult p;
    p.R_x_norm = values[i];
    p.R_x_norm_error = error;
    writer.write_point(i, p, {});
  }
  writer.close({});
  writer.publish();
  return evaluate_checks(ResultReader(s.path("c.h5")));
}

Verdict verdict(const std::vector<double>& values, double error, const std::string& check) {
  const Scratch s;
  return verdicts(s, values, error, check).at(0).verdict;
}

}  // namespace

TEST_CASE("trend: Kendall's tau, with what the errors leave open") {
  CHECK(trend({{curve({3, 2, 1}, 0)}, 0}).value == -1);
  CHECK(trend({{curve({1, 2, 4}, 0)}, 0}).value == 1);
  CHECK(trend({{curve({1, 3, 2}, 0)}, 0}).value == Approx(1.0 / 3));
  const Measurement noisy = trend({{curve({1, 1.1, 1.2}, 1)}, 0});
  CHECK(noisy.value == 0);
  CHECK(noisy.uncertainty == 1);
  CHECK(trend({{curve({3, 2, 1}, 0), curve({1, 2, 3}, 0)}, 0}).value == 0);
  CHECK(std::isnan(trend({{curve({1}, 0)}, 0}).value));
}

TEST_CASE("end_ratio and range_ratio, with their uncertainties") {
  const Measurement ratio = end_ratio({{curve({4, 7, 1}, 0.01)}, 0});
  CHECK(ratio.value == Approx(0.25));
  CHECK(ratio.uncertainty == Approx(0.25 * (0.01 / 4 + 0.01)));
  const Curves narrow{{curve({1, 2}, 0)}, 0}, wide{{curve({1, 4, 8}, 0)}, 0};
  CHECK(range_ratio(narrow, wide).value == Approx(1.0 / 3));
}

TEST_CASE("verdicts: supported, refuted, and undecided where the errors reach the threshold") {
  const std::string falls = R"("predicate": "end_ratio", "is": "at_most", "threshold": 0.5)";
  CHECK(verdict({1, 0.7, 0.3}, 1e-3, falls) == Verdict::supported);
  CHECK(verdict({1, 0.7, 0.8}, 1e-3, falls) == Verdict::refuted);
  CHECK(verdict({1, 0.7, 0.49}, 0.1, falls) == Verdict::undecided);
  CHECK(verdict({1, 0.7, 0.51}, 0.1, falls) == Verdict::undecided);
  const std::string rises = R"("predicate": "trend", "is": "at_least", "threshold": 0.5)";
  CHECK(verdict({1, 2, 3, 4}, 0.1, rises) == Verdict::supported);
  CHECK(verdict({4, 3, 2, 1}, 0.1, rises) == Verdict::refuted);
  CHECK(verdict({1, 2, 3, 4}, 5, rises) == Verdict::undecided);
}

TEST_CASE("points without values are left out and counted; without any the claim is undecided") {
  const Scratch s;
  const std::string falls = R"("predicate": "trend", "is": "at_most", "threshold": -0.5)";
  const auto some = verdicts(s, {3, kNone, 1}, 0, falls).at(0);
  CHECK(some.verdict == Verdict::supported);
  CHECK(some.measured.missing == 1);
  CHECK(verdicts(s, {kNone, kNone, 1}, 0, falls).at(0).verdict == Verdict::undecided);
  CHECK(verdicts(s, {3, 2, 1}, kNone, falls).at(0).verdict == Verdict::undecided);
}

TEST_CASE("a check that names what the result lacks is an error with the remedy") {
  const Scratch s;
  CHECK_THROWS_WITH(verdicts(s, {1, 2}, 0, R"("predicate": "range_ratio", "is": "at_most", "threshold": 1)"),
                    Catch::Contains("needs \"against\""));
  CHECK_THROWS_WITH(
      verdicts(s, {1, 2}, 0,
               R"("predicate": "range_ratio", "against": "k_rr", "is": "at_most", "threshold": 1)"),
      Catch::Contains("did you mean k_r?"));
}

TEST_CASE("checks are stored beside the numbers without changing their digest") {
  const Scratch s;
  const auto checks =
      verdicts(s, {3, 2, 1}, 0.1, R"("predicate": "trend", "is": "at_most", "threshold": -0.5)");
  const std::string before = payload_sha256(h5::open_file(s.path("c.h5"), false));
  write_checks(s.path("c.h5"), checks);
  write_checks(s.path("c.h5"), checks);
  CHECK(payload_sha256(h5::open_file(s.path("c.h5"), false)) == before);
  CHECK(checks_table(checks).find("supported") != std::string::npos);
}
