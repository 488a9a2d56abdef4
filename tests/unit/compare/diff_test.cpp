#include "compare/comparison.hpp"
#include "util/error.hpp"
#include "small_result.hpp"

#include "catch.hpp"

namespace bristle::diff_test {
using namespace testing;
using Catch::Contains;

namespace {

Comparison diff(const std::string& a, const std::string& b, const Tolerances& tolerances = {}) {
  return diff_results(ResultReader(a), ResultReader(b), tolerances);
}

// Two equal results. Tests change the second.
struct Two {
  Scratch s;
  std::string a = small_result(s, "a.h5"), b = small_result(s, "b.h5");

  Comparison compare(const Tolerances& tolerances = {}) const { return diff(a, b, tolerances); }
};

const Tolerances kGenerous{1e6, 1e6};

}  // namespace

TEST_CASE("diff: equal results agree in one line") {
  const Two two;
  const Comparison d = two.compare();
  CHECK(d.agree());
  CHECK(d.values > 200);
  CHECK_THAT(comparison_text(d), Contains("the same, bit for bit"));
  CHECK(two.compare(kGenerous).agree());
}

TEST_CASE(
    "diff: a difference in the last bit is reported with its point, in units of the sum of the error "
    "estimates") {
  const Two two;
  const double was = small_point(4).value[R_X], is = std::nextafter(was, 10);
  put(two.b, "R_x", {1, 1}, is);
  const Comparison d = two.compare();
  CHECK_FALSE(d.agree());
  CHECK(d.total(&Difference::values) == 1);
  REQUIRE(d.differences.size() == 1);
  CHECK(d.differences[0].name == "R_x");
  CHECK(d.differences[0].absolute == is - was);
  CHECK(d.differences[0].relative == (is - was) / is);
  CHECK(d.differences[0].tolerances == (is - was) / 2e-3);
  CHECK(d.differences[0].place == "k_r = 20, k_theta = 1");
  CHECK_THAT(comparison_text(d), Contains("R_x ") && Contains("k_r = 20, k_theta = 1"));
}

TEST_CASE("diff: zeros of opposite signs differ") {
  const Two two;
  put(two.b, "R_y_norm", {0, 0}, -0.0);
  CHECK_FALSE(two.compare().agree());
  CHECK(two.compare({1e-9, {}}).agree());
}

TEST_CASE("diff: numbers within the tolerances agree, and the worst difference comes first") {
  const Two two;
  put(two.b, "R_x", {0, 0}, small_point(0).value[R_X] * 1.001);
  put(two.b, "R_n", {0, 1}, small_point(1).value[R_N] * 1.01);
  const auto at = [&](double rtol) { return two.compare({rtol, {}}); };
  CHECK_FALSE(at(1e-4).agree());
  CHECK_FALSE(at(5e-3).agree());
  CHECK(at(1e-2).agree());
  CHECK_THAT(comparison_text(at(1e-2)), Contains("within the tolerances"));
  CHECK(at(1e-4).differences.at(0).name == "R_n");
  CHECK(at(1e-4).differences[0].tolerances == Approx(99.0).epsilon(0.01));
  CHECK(two.compare({{}, 0.1}).agree());
  CHECK_FALSE(two.compare({{}, 1e-3}).agree());
  CHECK_FALSE(two.compare({0.0, 0.0}).agree());
  CHECK_THROWS_AS(at(-1), InputError);
  CHECK_THROWS_AS(at(kNone), InputError);
}

TEST_CASE("diff: a variable without an error estimate has no unit") {
  const Two two;
  put(two.b, "passages", {0, 0}, 101);
  const Comparison d = two.compare();
  REQUIRE(d.differences.size() == 1);
  CHECK(std::isnan(d.differences[0].tolerances));
  CHECK_THAT(comparison_text(d), Contains(" - "));
}

TEST_CASE("diff: NaN and infinity differ from numbers at any tolerance, and NaN equals NaN") {
  const double bad = GENERATE(as<double>(), kNone, INFINITY, -INFINITY);
  const Two two;
  put(two.b, "R_x", {0, 2}, bad);
  const Comparison d = two.compare(kGenerous);
  CAPTURE(bad);
  CHECK_FALSE(d.agree());
  REQUIRE(d.differences.size() == 1);
  CHECK(d.differences[0].tolerances == INFINITY);
  CHECK_THAT(comparison_text(d), Contains("R_x ") && Contains("k_r = 5, k_theta = 3: "));
  put(two.a, "R_x", {0, 2}, bad);
  CHECK(two.compare().agree());
}

TEST_CASE("diff: missing and extra variables, different shapes and kinds of numbers are differences") {
  const Two two;
  SECTION("missing") {
    remove_dataset(two.b, "R_x");
    CHECK_THAT(two.compare(kGenerous).failures.at(0), Contains("R_x: only in " + two.a));
  }
  SECTION("extra") {
    add_dataset(two.b, "gamma_4", {2, 3});
    CHECK_THAT(two.compare(kGenerous).failures.at(0), Contains("gamma_4: only in " + two.b));
  }
  SECTION("shape") {
    remove_dataset(two.b, "R_x");
    add_dataset(two.b, "R_x", {6});
    CHECK_THAT(two.compare(kGenerous).failures.at(0),
               Contains("R_x: different shapes: 2 x 3 over k_r x k_theta against 6"));
  }
  SECTION("type") {
    remove_dataset(two.b, "status");
    add_dataset(two.b, "status", {2, 3});
    CHECK_THAT(two.compare(kGenerous).failures.at(0), Contains("status: different kinds of numbers"));
  }
  CHECK_FALSE(two.compare(kGenerous).agree());
}

TEST_CASE("diff: different flags are shown by their meanings") {
  const Two two;
  put(two.b, "status", {1, 0}, 1);
  const Comparison d = two.compare(kGenerous);
  CHECK_FALSE(d.agree());
  CHECK_THAT(comparison_text(d),
             Contains("status ") && Contains("k_r = 20, k_theta = 0.3: ok against load_jump"));
}

TEST_CASE("diff: variables over an axis with different values are not compared") {
  const Two two;
  put(two.b, "k_theta", {1}, std::nextafter(1.0, 2.0));
  const Comparison d = two.compare(kGenerous);
  CHECK_FALSE(d.agree());
  CHECK_THAT(d.failures.at(0), Contains("k_theta: different coordinates: 1.0000000000000002 of " + two.b));
  CHECK_THAT(d.failures.at(1), Contains("more variables: not compared, because the coordinates of k_theta"));
  CHECK(d.values == 0);
}

TEST_CASE("diff: a file with a part of the points is compared at these points, but does not agree") {
  const Scratch s;
  small_experiment(s);
  const std::string all = small_result(s, "a.h5");
  const Experiment less = load_experiment(
      s.write("less.json",
              R"({"extends": "small.json", "name": "small", "sweep": {"k_theta": {"values": [1, 3]}}})"),
      {{}, "full"});
  const std::string part = small_result(
      s, "b.h5", less, [](std::size_t i, PointResult& p) { p = small_point(i / 2 * 3 + i % 2 + 1); });
  const Comparison d = diff(all, part);
  CHECK_FALSE(d.agree());
  CHECK(d.differences.empty());
  REQUIRE(d.failures.size() == 1);
  CHECK_THAT(d.failures[0],
             Contains("k_theta: different coordinates: 3 values in " + all + ", 2 of them in " + part));
  CHECK_THAT(comparison_text(d), Contains("at 4 of 6 points: FAILED"));
  CHECK_THAT(diff(part, all).failures.at(0), Contains("k_theta: different coordinates: 0.3 of " + all));
}

TEST_CASE("diff: groups except /provenance and /checks are compared, and different experiments are named") {
  const Two two;
  const auto add = [](const std::string& path, const std::string& group, double value) {
    h5::create_group(h5::open_file(path, true), group);
    add_dataset(path, group + "/x", {2});
    put(path, group + "/x", {1}, value);
  };
  for (const char* group : {"provenance/more", "checks"}) {
    add(two.a, group, 1);
    add(two.b, group, 2);
  }
  CHECK(two.compare().agree());
  add(two.a, "tables", 1);
  add(two.b, "tables", 3);
  const Comparison d = two.compare();
  REQUIRE(d.differences.size() == 1);
  CHECK(d.differences[0].name == "tables/x");
  CHECK(d.differences[0].place == "row 1");
  const Scratch s;
  const std::string other = small_result(s, "c.h5", small_experiment(s, R"(, "title": "t", "figure": "9")"));
  h5::write_attribute(h5::open_file(other, true), "name", "large");
  const Comparison named = diff(two.a, other);
  CHECK_THAT(named.notes.at(0), Contains("different experiments: small and large"));
}

}  // namespace bristle::diff_test
