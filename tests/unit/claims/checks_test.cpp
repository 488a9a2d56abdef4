#include "claims/checks.hpp"
#include "claims/measure.hpp"
#include "util/error.hpp"
#include "generators.hpp"
#include "small_result.hpp"

#include "catch.hpp"
#include <cmath>

namespace bristle::checks_test {
using namespace testing;

namespace {

Curve curve(const std::vector<double>& values, double error, double first_x = 1) {
  Curve c;
  for (const double v : values) c.push_back({first_x + double(c.size()), v, error});
  return c;
}

Curves one(const Curve& c) { return {{c}, 0}; }

// The evaluated checks of a result with the given values of R_x_norm and, if any, of z_0.
std::vector<CheckResult> evaluated(const Scratch& s, const std::vector<double>& values, double error,
                                   const std::string& sweep_and_checks,
                                   const std::vector<double>& gaps = {}) {
  s.write("paper.json", bytes_of(std::string(BRISTLE_EXPERIMENTS) + "/paper.json"));
  const Experiment e = load_experiment(
      s.write("c.json", R"({"extends": "paper.json", "name": "c", )" + sweep_and_checks + "}"), {});
  validate_checks(e);
  ResultWriter writer(e, s.path("c.h5"));
  for (std::size_t i = 0; i < values.size(); ++i) {
    PointResult p;
    p.R_x_norm.value = values[i];
    p.R_x_norm.error = error;
    if (!gaps.empty()) p.z_0 = gaps[i];
    writer.write(i, record_of(layout_of(e.sweep), p, {}));
  }
  writer.close({});
  writer.publish();
  return evaluate_checks(ResultReader(s.path("c.h5")));
}

// The same with one check of values over k_r.
std::vector<CheckResult> verdicts(const Scratch& s, const std::vector<double>& values, double error,
                                  const std::string& check, const std::vector<double>& gaps = {}) {
  return evaluated(s, values, error,
                   R"("sweep": {"k_r": {"linspace": [1, 10, )" + std::to_string(values.size()) +
                       R"(]}}, "checks": [{"claim": "x", "statement": "y",
        "variable": "R_x_norm", "along": "k_r", )" +
                       check + "}]",
                   gaps);
}

Verdict verdict(const std::vector<double>& values, double error, const std::string& check) {
  const Scratch s;
  return verdicts(s, values, error, check).at(0).verdict;
}

}  // namespace

TEST_CASE("trend: Kendall's tau, its uncertainty and its significance") {
  CHECK(trend({{curve({3, 2, 1}, 0)}, 0}).value == -1);
  CHECK(trend({{curve({1, 2, 4}, 0)}, 0}).value == 1);
  CHECK(trend({{curve({1, 3, 2}, 0)}, 0}).value == Approx(1.0 / 3));
  const Measurement noisy = trend({{curve({1, 1.1, 1.2}, 1)}, 0});
  CHECK(noisy.value == 0);
  CHECK(noisy.error == 1);
  CHECK(trend({{curve({3, 2, 1}, 0), curve({1, 2, 3}, 0)}, 0}).value == 0);
  CHECK(std::isnan(trend({{curve({1}, 0)}, 0}).value));
  CHECK(trend(one(curve({1, 2, 3, 4, 5}, 0))).significance == Approx(0.0143).epsilon(0.01));
  CHECK(trend(one(curve({1, 2, 3}, 0))).significance > 0.05);
  Curve backwards = curve({3, 2, 1}, 0);
  for (CurvePoint& p : backwards) p.x = -p.x;
  CHECK(trend(one(backwards)).value == 1);
  for (CurvePoint& p : backwards) p.x_error = 5;
  CHECK(trend(one(backwards)).error == 1);
}

TEST_CASE("property: trend counts all pairs of points whose errors do not overlap") {
  rc::prop("as one pair after the other", [] {
    Curve points;
    for (int i = *rc::gen::inRange(2, 40); i > 0; --i) {
      const auto number = [](int most) { return double(*rc::gen::inRange(0, most)); };
      points.push_back({number(12), number(12), number(4), number(3), number(2) == 1});
    }
    for (const PointPairs counted : {PointPairs::all, PointPairs::within, PointPairs::across}) {
      const auto sign = [](double change, double error) { return (change > error) - (change < -error); };
      long all = 0, difference = 0, decided = 0;
      for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
          const CurvePoint &a = points[i], &b = points[j];
          const bool across = a.behind_jump != b.behind_jump;
          if (counted != PointPairs::all && across != (counted == PointPairs::across)) continue;
          const int both =
              sign(a.x - b.x, a.x_error + b.x_error) * sign(a.value - b.value, a.error + b.error);
          ++all;
          difference += both;
          decided += both != 0;
        }
      const Measurement found = trend(one(points), counted);
      RC_ASSERT(std::isnan(found.value) == (all == 0));
      if (all == 0) continue;
      RC_ASSERT(found.value == double(difference) / double(all));
      RC_ASSERT(found.error == double(all - decided) / double(all));
    }
  });
}

TEST_CASE("trend: many points, with errors that are unknown") {
  Curve points;
  for (int i = 0; i < 100'000; ++i) points.push_back({double(i % 1000), double(i), 0.0});
  points.push_back({0, 0, NAN});
  const Measurement found = trend(one(points));
  // Pairs within a row rise; of pairs of two rows as many rise as fall.
  CHECK(found.value == Approx(100.0 * 1000 * 999 / 2 / (1e5 * (1e5 + 1) / 2)));
}

TEST_CASE("slope: of a power law and of a line, with common and with independent errors") {
  Curve power;
  for (const double x : {1.0, 2.0, 5.0, 10.0}) power.push_back({x, 3 * std::pow(x, -0.5), 0.01 * x});
  CHECK(slope(one(power), true).value == Approx(-0.5));
  CHECK(slope(one(curve({1, 3, 5}, 0)), false).value == Approx(2));
  Curves linear = one(curve({1, 3, 5}, 0.1)), independent = linear;
  independent.independent = true;
  CHECK(slope(linear, false).error == Approx(0.1));
  CHECK(slope(independent, false).error == Approx(0.1 / std::sqrt(2)));
  Curve in_x = curve({1, 3, 5}, 0);
  for (CurvePoint& p : in_x) p.x_error = 0.05;
  CHECK(slope(one(in_x), false).error == Approx(0.1));
}

TEST_CASE("plateau, level and fold with their uncertainties") {
  CHECK(plateau(one(curve({9, 10, 11}, 0.5))).value == Approx(0.2));
  CHECK(plateau(one(curve({9, 10, 11}, 0.5))).error == Approx(0.1));
  CHECK(level({{curve({1, 3}, 0.1), curve({5}, 0.1)}, 0}).value == Approx(3));
  const Curves bumps{{curve({3, 1.5, 2, 1}, 0.01), curve({3, 2, 1}, 0.01)}, 0};  // over an axis that falls
  CHECK(fold(bumps).value == Approx(0.25));
  // The errors, and the smaller differences to a neighbour, both 0.5, over 2.
  CHECK(fold(bumps).error == Approx((0.01 + 0.01 + 0.5 + 0.5) / 2));
  CHECK(fold(one(curve({3, 2, 1}, 0.01))).value == 0);
}

TEST_CASE("steepest fall: abscissa, slope and width with uncertainties from the spacing of the points") {
  Curve step;
  for (const double x : {1.0, 2.0, 4.0, 8.0, 16.0}) step.push_back({x, x < 4 ? 1 : x < 8 ? 0.9 : 0.3, 0});
  const Measurement place = steepest_fall(one(step));
  CHECK(place.value == Approx(std::sqrt(32)));
  CHECK(place.value - place.error <= 4);
  CHECK(place.value + place.error >= 8);
  CHECK(steepness(one(step)).value == Approx(std::log(3) / std::log(2)));
  const Measurement width = fall_width(one(step));
  CHECK(width.value < std::log(2));
  CHECK(width.error == Approx(std::log(2)));
  for (CurvePoint& p : step) p.error = 0.3;
  CHECK(steepest_fall(one(step)).error > place.error);  // its neighbours agree within the errors
}

TEST_CASE("ordering, concordance and equality of two quantities within the errors") {
  CHECK(ordering(curve({2, 3}, 0.1), curve({1, 1}, 0.1)).value == 1);
  CHECK(ordering(curve({2, 1.1}, 0.1), curve({1, 1}, 0.1)).error == Approx(0.5));
  CHECK(concordance(curve({1, 2, 3, 4}, 0), curve({10, 20, 30, 40}, 0)).value == 1);
  CHECK(concordance(curve({1, 2, 3, 4}, 0), curve({4, 3, 2, 1}, 0)).value == -1);
  CHECK(concordance(curve({1, kNone, 3}, 0), curve({1, 2, 3}, 0)).missing == 1);
  const Curve a = curve({1, 2, 3, 4}, 0.3), b = curve({1.5, 1.5, 3.5, 3.5}, 0.4);
  CHECK(equality(a, b, 1).value == Approx(1));
  CHECK(equality(a, b, 1).error == Approx(1 / std::sqrt(8)));
  CHECK(std::isinf(equality(a, b, 0.4).error));  // with errors this large, agreement is meaningless
  CHECK(equality(a, curve({3, 0, 5, 2}, 0.4), 1).value == Approx(4));
}

TEST_CASE("end_ratio and range_ratio, with their uncertainties") {
  const Measurement ratio = end_ratio({{curve({4, 7, 1}, 0.01)}, 0});
  CHECK(ratio.value == Approx(0.25));
  CHECK(ratio.error == Approx(0.25 * (0.01 / 4 + 0.01)));
  CHECK(rise({{curve({4, 7, 1}, 0.01)}, 0}).value == Approx(std::log(0.25)));
  CHECK(rise({{curve({4, 7, 1}, 0.01)}, 0}).error == Approx(0.01 / 4 + 0.01));
  const Measurement top = top_ratio({{curve({4, 8, 1}, 0.1), curve({1, 1}, 0.1)}, 0});
  CHECK(top.value == Approx(std::sqrt(2)));
  CHECK(top.error == Approx(std::sqrt(2) * (0.1 / 8 + 0.1 / 4 + 0.2) / 2));
  const Curves narrow{{curve({1, 2}, 0)}, 0}, wide{{curve({1, 4, 8}, 0)}, 0};
  CHECK(range_ratio(narrow, wide).value == Approx(1.0 / 3));
}

TEST_CASE("share: of a factor in the change of its product") {
  Curve factor;  // the abscissa is the product: it falls by 8, the factor by 2
  for (const auto& [product, value] : {std::pair{8., 2.}, {9., 3.}, {1., 1.}})
    factor.push_back({product, value, 0.1, 0.2});
  const Measurement part = share(one(factor));
  CHECK(part.value == Approx(1.0 / 3));
  CHECK(part.error == Approx((0.1 + 0.05 + (0.2 + 0.2 / 8) / 3) / std::log(8)));
}

TEST_CASE("third_ratio: the mean of the last third over the mean of the first") {
  const Curves steps = one(curve({1, 4, 7, 7, 7, 2, 8}, 0.1));
  CHECK(third_ratio(steps).value == Approx(2));
  CHECK(third_ratio(steps).error == Approx(2 * (0.1 + 0.1 / 4 + 0.1 / 2 + 0.1 / 8) / 2));
  CHECK(third_ratio(one(curve({1, 3}, 0))).value == Approx(3));
}

TEST_CASE("linearity: the distance from the least-squares line over the line's range") {
  CHECK(linearity(one(curve({1, 3, 5}, 0.2))).value == Approx(0).margin(1e-12));
  CHECK(linearity(one(curve({1, 3, 5}, 0.2))).error == Approx(0.05));
  CHECK(linearity(one(curve({1, 3, 2, 4}, 0))).value == Approx(std::sqrt(0.45) / 2.4));
  CHECK(linearity(one(curve({1, 3}, 0))).curves == 0);  // two points always lie on a line
}

TEST_CASE("trend within the branches of a curve and across its jump") {
  Curve c = curve({1, 2, 3, 0, -1, -2, -3}, 0);  // rises, jumps down, and falls
  for (std::size_t i = 3; i < c.size(); ++i) c[i].behind_jump = true;
  using claims::PointPairs;
  CHECK(trend(one(c), PointPairs::within).value == Approx((3 - 6) / 9.0));
  CHECK(trend(one(c), PointPairs::across).value == -1);
  CHECK(trend(one(c)).value == Approx((3 - 6 - 12) / 21.0));
  // As many pairs across as the sum of ranks of Wilcoxon's test: variance 3 x 4 x 8/3.
  CHECK(trend(one(c), PointPairs::across).significance == Approx(std::erfc(12 / std::sqrt(2 * 32.0))));
}

TEST_CASE("a check distinguishes pairs of points by the largest rise of the gap") {
  const auto tau = [](const char* pairs) {
    const Scratch s;
    return verdicts(s, {5, 6, 1, 2}, 0,
                    std::string(R"("predicate": "trend", "is": "at_least", "threshold": 0.5)") + pairs,
                    {0.1, 0.12, 0.5, 0.55})
        .at(0)
        .measured.value;
  };
  CHECK(tau(R"(, "pairs": "within")") == 1);
  CHECK(tau(R"(, "pairs": "across")") == -1);
  CHECK(tau("") == Approx(-1.0 / 3));
}

TEST_CASE("directions of two changes are compared only if both are large enough") {
  const Scratch s;
  const std::string sweep =
      R"("sweep": {"friction": {"values": ["nss", "coulomb"]}, "k_r": {"values": [1, 2]}}, "checks": [
    {"claim": "x", "statement": "y", "variable": "R_x_norm", "along": "k_r", "predicate": "rise", "is": "at_least",
     "threshold": 0, "compare": {"friction": ["nss", "coulomb"]}, "resolution": 0.05}])";
  CHECK(evaluated(s, {1, 1.2, 1, 1.1}, 1e-3, sweep).at(0).verdict == Verdict::supported);
  CHECK(evaluated(s, {1, 1.2, 1, 0.9}, 1e-3, sweep).at(0).verdict == Verdict::refuted);
  CHECK(evaluated(s, {1, 1.2, 1, 1.04}, 1e-3, sweep).at(0).verdict == Verdict::undecided);
}

TEST_CASE("a comparison of several axes takes the first values of all, then the second values of all") {
  const Scratch s;
  const std::string sweep =
      R"("sweep": {"friction": {"values": ["nss", "coulomb"]}, "k_r": {"values": [1, 2]}}, "checks": [
    {"claim": "x", "statement": "y", "variable": "R_x_norm", "along": "k_r", "predicate": "level", "is": "at_least",
     "threshold": 0, "compare": {"friction": ["nss", "coulomb"], "k_r": [2, 1]}}])";
  CHECK(evaluated(s, {1, 12, 3, 5}, 0, sweep).at(0).measured.value == Approx(4));
}

TEST_CASE("verdicts: supported, refuted, and undecided if the threshold is within the errors") {
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

TEST_CASE("verdicts: near, selections, comparisons, and trends of too few points") {
  const auto near = [](double threshold) {
    return R"("predicate": "level", "is": "near", "band": 0.2, "threshold": )" + std::to_string(threshold);
  };
  CHECK(verdict({1, 1, 1}, 0.01, near(1.1)) == Verdict::supported);
  CHECK(verdict({1, 1, 1}, 0.01, near(1.5)) == Verdict::refuted);
  CHECK(verdict({1, 1, 1}, 0.05, near(1.22)) == Verdict::undecided);
  CHECK(verdict({1, 2, 3}, 0, R"("predicate": "trend", "is": "at_least", "threshold": 0.5)") ==
        Verdict::undecided);  // three points in random order are monotonic with probability 1/3
  CHECK(verdict({9, 1, 1}, 0.01,
                R"("predicate": "level", "where": {"k_r": [2, 20]}, "is": "at_most", "threshold": 2)") ==
        Verdict::supported);
  const std::string falls =
      R"("predicate": "level", "compare": {"k_r": [10, 1]}, "is": "at_most", "threshold": )";
  CHECK(verdict({2, 7, 1}, 0.01, falls + "0.6") == Verdict::supported);
  CHECK(verdict({2, 7, 1}, 0.01, falls + R"(-0.8, "by": "difference")") == Verdict::supported);
  CHECK(verdict({2, 7, 1}, 0.01, falls + R"(0.6, "divide_by": {"R_n": -1})") ==
        Verdict::undecided);  // R_n is 0
}

namespace {

// A check of values 1 to 4 over k_r that is supported or refuted.
std::string level(bool supported, const std::string& keys) {
  return std::string(R"({"claim": "x", "statement": "y", "variable": "R_x_norm", "along": "k_r",
    "predicate": "level", "is": "at_most", "threshold": )") +
         (supported ? "9" : "1") + keys + "}";
}

Verdict claim_verdict(const std::vector<std::string>& checks) {
  const Scratch s;
  std::string list;
  for (const std::string& check : checks) list += (list.empty() ? "" : ", ") + check;
  const auto results = evaluated(s, {1, 2, 3, 4}, 0.1,
                                 R"("sweep": {"k_r": {"linspace": [1, 10, 4]}}, "checks": [)" + list + "]");
  CHECK(claim_verdicts(results).size() == 1);
  return results.front().claim_verdict;
}

}  // namespace

TEST_CASE("the main checks of one interpretation decide the verdict on a claim, and further checks do not") {
  const std::string further = R"(, "role": "further")", one = R"(, "interpretation": "one")",
                    other = R"(, "interpretation": "other")";
  CHECK(claim_verdict({level(true, ""), level(true, "")}) == Verdict::supported);
  CHECK(claim_verdict({level(true, ""), level(false, "")}) == Verdict::refuted);
  CHECK(claim_verdict({level(true, ""), level(false, further)}) == Verdict::supported);
  CHECK(claim_verdict({level(false, ""), level(true, further)}) == Verdict::refuted);
  CHECK(claim_verdict({level(false, one), level(true, one), level(true, other)}) == Verdict::depends);
  CHECK(claim_verdict({level(true, one), level(true, other)}) == Verdict::supported);
  CHECK(claim_verdict({level(false, one), level(false, other)}) == Verdict::refuted);
  CHECK(claim_verdict({level(true, further)}) == Verdict::undecided);  // no check decides it
}

TEST_CASE("checks speak in words: shares of points in per cent, other numbers with what they measure") {
  const Scratch s;
  const auto words = [&](const std::vector<double>& values, const std::string& check) {
    const CheckResult c = verdicts(s, values, 0, check).at(0);
    return std::pair(required_text(c.check), found_text(c));
  };
  using Pair = std::pair<std::string, std::string>;
  const std::string ordering = R"("predicate": "ordering", "expected": 2.5, "threshold": )";
  CHECK(words({1, 1, 1, 3}, ordering + R"(-0.9, "is": "at_most")") ==
        Pair{"95 % of the points needed", "75 %"});
  CHECK(words({1, 1, 1, 3}, ordering + R"(0, "is": "at_least")") ==
        Pair{"50 % of the points needed", "25 %"});
  CHECK(words({4, 3, 2, 1}, R"("predicate": "trend", "is": "at_most", "threshold": -0.5)") ==
        Pair{"75 % of the pairs of points needed", "100 %"});
  CHECK(words({4, 3, 2, 1}, R"("predicate": "end_ratio", "is": "at_most", "threshold": 0.5)") ==
        Pair{"last over first value at most 0.5", "0.250 +- 0.000"});
  CHECK(words({2, 2, 2, 2}, R"("predicate": "level", "is": "near", "threshold": 1, "band": 0.05)").first ==
        "mean value within 0.05 of 1");
  CHECK(
      words({kNone, kNone, kNone, 1}, R"("predicate": "trend", "is": "at_most", "threshold": -0.5)").second ==
      "not measured");
}

TEST_CASE("a check on pairs compares as many points with as many") {
  const Scratch s;
  const auto concordance = [&](const std::string& ranges) {
    return evaluated(s, {1, 2, 3, 4}, 0.1,
                     R"("sweep": {"k_r": {"linspace": [1, 10, 4]}}, "checks": [
      {"claim": "x", "statement": "y", "variable": "R_x_norm", "predicate": "concordance", "is": "at_least",
       "threshold": 0, "compare": {"k_r": )" +
                         ranges + "}}]");
  };
  CHECK_THROWS_WITH(concordance("[[1, 10], [1, 4]]"), Catch::Contains("compares 4 points with 2"));
}

TEST_CASE("with checks_for_each, every check has a verdict at each value of the choice") {
  const Scratch s;
  const std::string both = R"("sweep": {"bending": {"values": ["polar", "polar_as_printed"]},
    "k_r": {"values": [1, 2, 3]}}, "checks": [)" +
                           level(true, R"(, "where": {"k_r": [1, 2]})") + R"(], "checks_for_each": )";
  const auto results = evaluated(s, {1, 2, 90, 10, 20, 90}, 0.1, both + R"("bending")");
  REQUIRE(results.size() == 2);
  CHECK(results[0].check.reading == "polar");
  CHECK(results[0].measured.value == Approx(1.5));
  CHECK(results[0].claim_verdict == Verdict::supported);
  CHECK(results[1].check.reading == "polar_as_printed");
  CHECK(results[1].measured.value == Approx(15));
  CHECK(results[1].claim_verdict == Verdict::refuted);
  CHECK(results[1].check.number == 0);
  const std::string table = checks_table(results, false, 100);
  CHECK(table.find("corrected") < table.find("as printed"));
  CHECK(std::count(table.begin(), table.end(), '\n') == 3);  // the readings, the statement, both verdicts
  const std::string narrow = checks_table(results, false, 50);
  CHECK(narrow.find("\n         as printed refuted") != std::string::npos);
  CHECK_THROWS_WITH(evaluated(s, {}, 0, both + R"("k_r")"), Catch::Contains("is not a choice"));
  CHECK_THROWS_WITH(evaluated(s, {}, 0, both + R"("friction")"), Catch::Contains("is not a choice"));
}

TEST_CASE("points without values are omitted and counted, and without any value the claim is undecided") {
  const Scratch s;
  const std::string falls = R"("predicate": "trend", "is": "at_most", "threshold": -0.5)";
  const auto some = verdicts(s, {5, 4, kNone, 2, 1}, 0, falls).at(0);
  CHECK(some.verdict == Verdict::supported);
  CHECK(some.measured.missing == 1);
  CHECK(verdicts(s, {kNone, kNone, 1}, 0, falls).at(0).verdict == Verdict::undecided);
  CHECK(verdicts(s, {3, 2, 1}, kNone, falls).at(0).verdict == Verdict::undecided);
}

TEST_CASE("a check that names a missing variable, axis or value is an error with the remedy") {
  const Scratch s;
  const auto refused = [&](const char* check, const char* why) {
    CAPTURE(check);
    CHECK_THROWS_WITH(verdicts(s, {1, 2}, 0, std::string(check) + R"(, "is": "at_most", "threshold": 1)"),
                      Catch::Contains(why));
  };
  refused(R"("predicate": "range_ratio")", "/checks/0/against: is missing; range_ratio needs it");
  refused(R"("predicate": "range_ratio", "against": "k_rr")", "did you mean k_r?");
  refused(R"("predicate": "equality", "resolution": 1)", "/checks/0/compare: is missing");
  refused(R"("predicate": "level", "compare": {})", "/checks/0/compare: {} is not allowed");
  refused(R"("predicate": "trend", "where": {"k_r": 2.5})",
          "2.5 is not a value of this axis; allowed: 1, 10");
  refused(R"("predicate": "trend", "where": {"k_r": [2, 9]})",
          "[2.0,9.0] contains no value of this axis; allowed: 1, 10");
  refused(R"("predicate": "level", "compare": {"R_n": [1, 10]})", "a variable needs a range of two numbers");
  refused(R"("predicate": "level", "pairs": "within")", "/checks/0/pairs: is allowed with trend only");
  refused(R"("predicate": "share")", "/checks/0/x: is missing; share needs it");
  refused(R"("predicate": "trend", "where": {"gama_1": [1, 2]})", "did you mean gamma_1?");
  refused(R"("predicate": "trend", "compare": {"k_r": [1, 10, 3]})", "needs two values of the axis");
  CHECK_THROWS_WITH(verdicts(s, {1, 2}, 0, R"("predicate": "level", "is": "near", "threshold": 1)"),
                    Catch::Contains("/checks/0/band: is missing"));
}

TEST_CASE("checks are stored beside the numbers without changing their digest") {
  const Scratch s;
  const auto checks =
      verdicts(s, {5, 4, 3, 2, 1}, 0.1, R"("predicate": "trend", "is": "at_most", "threshold": -0.5)");
  const std::string before = payload_sha256(h5::open_file(s.path("c.h5"), false));
  write_checks(s.path("c.h5"), checks);
  write_checks(s.path("c.h5"), checks);
  CHECK(payload_sha256(h5::open_file(s.path("c.h5"), false)) == before);
  CHECK(h5::scale_name(h5::open_dataset(h5::open_file(s.path("c.h5"), false), "checks/verdict"), 0) ==
        "check");
  CHECK(checks_table(checks, false, 100).find("supported") != std::string::npos);
}

}  // namespace bristle::checks_test
