#include "compare/diff.hpp"
#include "util/error.hpp"
#include "small_result.hpp"

#include "catch.hpp"

namespace bristle::diff_test {
using namespace testing;
using Catch::Contains;

namespace {

Diff diff(const std::string& a, const std::string& b, const Tolerances& tolerances = {}) {
  return diff_results(ResultReader(a), ResultReader(b), tolerances);
}

// Two equal results. Tests change the second.
struct Two {
  Scratch s;
  std::string a = small_result(s, "a.h5"), b = small_result(s, "b.h5");

  Diff compare(const Tolerances& tolerances = {}) const { return diff(a, b, tolerances); }
};

const Tolerances kGenerous{1e6, 1e6};

}  // namespace

TEST_CASE("diff: equal results agree in one line") {
  const Two two;
  const Diff d = two.compare();
  CHECK(d.agree());
  CHECK(d.same == d.compared);
  CHECK(d.compared > 30);
  CHECK_THAT(diff_text(d), Contains("the same, bit for bit"));
  CHECK(two.compare(kGenerous).agree());
}

TEST_CASE(
    "diff: a difference in the last bit is reported with its point, in units of the sum of the error "
    "estimates") {
  const Two two;
  const double was = small_point(4).value[R_X], is = std::nextafter(was, 10);
  put(two.b, "R_x", {1, 1}, is);
  const Diff d = two.compare();
  CHECK_FALSE(d.agree());
  CHECK(d.same == d.compared - 1);
  REQUIRE(d.numbers.size() == 1);
  CHECK(d.numbers[0].name == "R_x");
  CHECK(d.numbers[0].absolute == is - was);
  CHECK(d.numbers[0].relative == (is - was) / is);
  CHECK(d.numbers[0].units == (is - was) / 2e-3);
  CHECK(d.numbers[0].place == "k_r = 20, k_theta = 1");
  CHECK_THAT(diff_text(d), Contains("R_x ") && Contains("k_r = 20, k_theta = 1"));
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
  CHECK_THAT(diff_text(at(1e-2)), Contains("within the tolerances"));
  CHECK(at(1e-4).numbers.at(0).name == "R_n");
  CHECK(at(1e-4).numbers[0].units == Approx(99.0).epsilon(0.01));
  CHECK(two.compare({{}, 0.1}).agree());
  CHECK_FALSE(two.compare({{}, 1e-3}).agree());
  CHECK_FALSE(two.compare({0.0, 0.0}).agree());
  CHECK_THROWS_AS(at(-1), InputError);
  CHECK_THROWS_AS(at(kNone), InputError);
}

TEST_CASE("diff: a variable without an error estimate has no unit") {
  const Two two;
  put(two.b, "passages", {0, 0}, 101);
  const Diff d = two.compare();
  REQUIRE(d.numbers.size() == 1);
  CHECK_FALSE(d.numbers[0].units);
  CHECK_THAT(diff_text(d), Contains(" - "));
}

TEST_CASE("diff: NaN and infinity differ from numbers at any tolerance, and NaN equals NaN") {
  const double bad = GENERATE(as<double>(), kNone, INFINITY, -INFINITY);
  const Two two;
  put(two.b, "R_x", {0, 2}, bad);
  const Diff d = two.compare(kGenerous);
  CAPTURE(bad);
  CHECK_FALSE(d.agree());
  REQUIRE(d.incomparable.size() == 1);
  CHECK_THAT(d.incomparable[0], Contains("R_x: ") && Contains("k_r = 5, k_theta = 3"));
  put(two.a, "R_x", {0, 2}, bad);
  CHECK(two.compare().agree());
}

TEST_CASE("diff: missing and extra variables, different shapes and kinds of numbers are differences") {
  const Two two;
  SECTION("missing") {
    remove_dataset(two.b, "R_x");
    CHECK_THAT(two.compare(kGenerous).incomparable.at(0), Contains("R_x: only in " + two.a));
  }
  SECTION("extra") {
    add_dataset(two.b, "gamma_4", {2, 3});
    CHECK_THAT(two.compare(kGenerous).incomparable.at(0), Contains("gamma_4: only in " + two.b));
  }
  SECTION("shape") {
    remove_dataset(two.b, "R_x");
    add_dataset(two.b, "R_x", {6});
    CHECK_THAT(two.compare(kGenerous).incomparable.at(0),
               Contains("R_x: different shapes: 2 x 3 over k_r x k_theta against 6"));
  }
  SECTION("type") {
    remove_dataset(two.b, "status");
    add_dataset(two.b, "status", {2, 3});
    CHECK_THAT(two.compare(kGenerous).incomparable.at(0), Contains("status: different kinds of numbers"));
  }
  CHECK_FALSE(two.compare(kGenerous).agree());
}

TEST_CASE("diff: different flags are shown by their meanings") {
  const Two two;
  put(two.b, "status", {1, 0}, 1);
  const Diff d = two.compare(kGenerous);
  CHECK_FALSE(d.agree());
  CHECK_THAT(d.incomparable.at(0), Contains("status: ok against load_jump at k_r = 20, k_theta = 0.3"));
}

TEST_CASE("diff: variables over an axis with different values are not compared") {
  const Two two;
  put(two.b, "k_theta", {1}, std::nextafter(1.0, 2.0));
  const Diff d = two.compare(kGenerous);
  CHECK_FALSE(d.agree());
  CHECK_THAT(d.incomparable.at(0),
             Contains("k_theta: different coordinates: 1 against 1.0000000000000002 at index 1"));
  CHECK_THAT(d.incomparable.at(1), Contains("over k_theta are not compared"));
  CHECK(d.same == 1);  // k_r
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
  const Diff d = two.compare();
  REQUIRE(d.numbers.size() == 1);
  CHECK(d.numbers[0].name == "tables/x");
  CHECK(d.numbers[0].place == "row 1");
  const Scratch s;
  const std::string other = small_result(s, "c.h5", small_experiment(s, R"(, "title": "t", "figure": "9")"));
  h5::write_attribute(h5::open_file(other, true), "name", "large");
  const Diff named = diff(two.a, other);
  CHECK_THAT(named.notes.at(0), Contains("different experiments: small and large"));
}

}  // namespace bristle::diff_test
