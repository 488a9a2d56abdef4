#include "compare/comparison.hpp"
#include "compare/reference.hpp"
#include "compare/replay.hpp"
#include "util/error.hpp"
#include "shards.hpp"

#include "catch.hpp"

namespace bristle::reference_test {
using namespace testing;
using Catch::Contains;
using Catch::EndsWith;

namespace {

Comparison compare_files(const std::string& file, const Json& reference) {
  const ResultReader result(file);
  return compare_with(result, evaluate_checks(result), reference, "reference/small.json");
}

// A result, its reference, and a copy of the result, which tests change.
struct Pair {
  Scratch s;
  std::string a = small_result(s, "a.h5"), b = small_result(s, "b.h5");
  Json reference = reference_of(a);

  Comparison report() const { return compare_files(b, reference); }
  std::string text() const { return comparison_text(report()); }
  // Changes R_x at k_r = 20, k_theta = 0.3 by the given number of its tolerances.
  void move_R_x(double tolerances) const {
    const Json& v = reference["variables"]["R_x"];
    put(b, "R_x", {1, 0}, v["values"][1][0].get<double>() + tolerances * v["tolerance"].get<double>());
  }
};

}  // namespace

TEST_CASE("reference: the axis of a choice has words, whatever their codes") {
  const Scratch s;
  const Experiment experiment =
      sharded(s, "", R"("friction": {"values": ["coulomb", "nss"]}, "k_r": {"values": [5, 20]})");
  const std::string file = small_result(s, "a.h5", experiment);
  Json reference = reference_of(file);
  CHECK(reference["axes"]["friction"] == Json({"coulomb", "nss"}));
  CHECK(compare_files(file, reference).agree());
  Json other_order = reference;
  std::swap(other_order["axes"]["friction"][0], other_order["axes"]["friction"][1]);
  CHECK_FALSE(compare_files(file, other_order).agree());
  reference["axes"]["friction"][1] = "no_longer_a_law";
  CHECK_THROWS_WITH(
      compare_files(file, reference),
      Contains("/axes/friction: the result") && Contains("does not know \"no_longer_a_law\"; it knows nss,"));
}

TEST_CASE("reference: its content, and tolerances that are rounded down to two digits") {
  const Scratch s;
  const std::string file = small_result(s, "a.h5");
  const double scale = small_point(5).value[bristle::R_X], integrator = 10 * 1e-4 * scale;
  put(file, "R_x_err", {0, 1}, 5e-3);
  put(file, "R_x", {1, 1}, kNone);
  const Json r = reference_of(file);
  CHECK(r["axes"].items().begin().key() == "k_r");
  CHECK(r["axes"]["k_theta"] == Json({0.3, 1, 3}));
  CHECK(r["flags"]["status"] == Json({{0, 0, 0}, {0, 0, 0}}));
  CHECK(r["claims"][0]["verdict"] == "supported");
  CHECK_FALSE(r["variables"].contains("passages"));
  CHECK_FALSE(r["variables"].contains("R_x_err"));
  const Json& tolerance = r["variables"]["R_x"]["tolerance"];
  REQUIRE(tolerance.size() == 2);
  for (const auto& [value, exact] :
       {std::pair(tolerance[0][0], 2e-3 + integrator), std::pair(tolerance[0][1], 1e-2 + integrator)}) {
    CHECK(value.get<double>() <= exact);
    CHECK(value.get<double>() == Approx(exact).epsilon(0.1));
    CHECK(value.dump().size() <= 6);
  }
  CHECK(tolerance[1][1] == 0.0);                         // no value
  const Json& R_n = r["variables"]["R_n"]["tolerance"];  // with orientation.rtol of the target
  CHECK(R_n ==
        Approx(2 * (1e-3 + 1e-3 * 2) + integrator / scale * small_point(5).value[bristle::R_N]).epsilon(0.1));
  CHECK(r["variables"]["jump_z_0"]["tolerance"] == 0.0);
}

TEST_CASE("reference: errors of any size give finite tolerances") {
  const Scratch s;
  const std::string file = small_result(s, "a.h5");
  const auto tolerance_with = [&](double error) {
    put(file, "R_x_err", {0, 1}, error);
    return reference_of(file)["variables"]["R_x"]["tolerance"][0][1].get<double>();
  };
  CHECK(tolerance_with(1.5e308) == 1.7e308);
  CHECK(tolerance_with(INFINITY) > 0);
  for (std::size_t i = 0; i < 6; ++i) put(file, "R_x", {i / 3, i % 3}, 0);
  CHECK(tolerance_with(5e-324) == 0);
  CHECK(tolerance_with(1.23e-300) == 2.4e-300);
}

TEST_CASE("reference: a file that is read and written again is unchanged") {
  const Pair p;
  const std::string text = json_lines(p.reference);
  CHECK(text.back() == '\n');
  CHECK(file_text(read_reference(p.s.write("r.json", text))) == text);
  CHECK_THAT(text, Contains("\"jump_z_0\": {\n   \"values\": [[],[]],\n"));
}

TEST_CASE("reference: a row ends after its last value, and a point without a value within it is null") {
  const Pair p;
  for (const hsize_t j : {0, 2}) put(p.b, "R_x", {1, j}, kNone);
  const Json r = reference_of(p.b);
  const Json &values = r["variables"]["R_x"]["values"], old = p.reference["variables"]["R_x"]["values"];
  CHECK(values[0] == old[0]);
  REQUIRE(values[1].size() == 2);
  CHECK(values[1][0].is_null());
  CHECK_THAT(json_lines(r), Contains("[null,"));
  const Json again = Json::parse(file_text(read_reference(p.s.write("r.json", json_lines(r)))));
  CHECK(compare_files(p.b, again).differences.empty());
  CHECK(compare_files(p.a, again).total(&Difference::above) == 2);
  CHECK(compare_files(p.b, p.reference).total(&Difference::above) == 2);
}

TEST_CASE("deviations: none, above half a tolerance, and above the tolerance") {
  const Pair p;
  CHECK(p.report().agree());
  CHECK(p.report().differences.empty());
  CHECK_THAT(p.text(), Contains("6 points: the same, bit for bit"));
  p.move_R_x(0.6);
  CHECK(p.report().agree());
  CHECK(p.report().differences.at(0).tolerances == Approx(0.6));
  CHECK_THAT(p.text(), Contains("above half its tolerance") && Contains("k_r = 20, k_theta = 0.3"));
  p.move_R_x(-1.5);
  CHECK_FALSE(p.report().agree());
  CHECK(p.report().differences.at(0).tolerances == Approx(1.5));
  CHECK(p.report().differences[0].where == 3);
  CHECK_THAT(p.text(), Contains("FAILED"));
  CHECK_THAT(ReplayCommands(ResultReader(p.b)).of_point(p.report().differences[0].where),
             EndsWith("bristle run " + p.b + " -o results/replay.h5 --point 3"));
}

TEST_CASE("deviations: the worst value of each variable, in descending order, and how many differ") {
  const Pair p;
  for (hsize_t i = 0; i < 2; ++i)
    for (hsize_t j = 0; j < 3; ++j)
      for (const char* name : {"R_x", "R_n", "gamma_1", "gamma_2", "gamma_3"})
        put(p.b, name, {i, j}, double(10 * i + j) + 0.05);
  const Comparison report = p.report();
  CHECK(report.total(&Difference::above) == 30);
  REQUIRE(report.differences.size() == 5);
  for (std::size_t i = 1; i < report.differences.size(); ++i)
    CHECK(report.differences[i - 1].tolerances >= report.differences[i].tolerances);
  CHECK_THAT(p.text(), Contains("FAILED: 30 values differ, 30 of them above their tolerances"));
  const Json json = comparison_json(report);
  CHECK(json["failed"] == true);
  CHECK(json["worst"].size() == 5);
  CHECK(json["worst"][0]["place"] == report.differences[0].place);
}

TEST_CASE("deviations: NaN and infinity fail, in either direction") {
  const Pair p;
  SECTION("a value was lost") { put(p.b, "R_x", {1, 2}, kNone); }
  SECTION("infinite") { put(p.b, "R_x", {1, 2}, INFINITY); }
  SECTION("a new value") { put(p.b, "jump_z_0", {1, 2}, 0.5); }
  CHECK_FALSE(p.report().agree());
  CHECK(p.report().differences.at(0).tolerances == INFINITY);
  CHECK_THAT(p.text(), Contains("k_r = 20, k_theta = 3: ") && Contains("  FAILED"));
}

TEST_CASE("deviations: missing and extra variables and different shapes, status and verdicts are failures") {
  Pair p;
  std::string expected;
  SECTION("missing") {
    remove_dataset(p.b, "R_x");
    expected = "R_x: only in reference/small.json";
  }
  SECTION("extra") {
    add_dataset(p.b, "gamma_4", {2, 3});
    expected = "gamma_4: only in " + p.b;
  }
  SECTION("shape") {
    remove_dataset(p.b, "R_x");
    add_dataset(p.b, "R_x", {6});
    expected = "R_x: different shapes: 6 over ";
  }
  SECTION("dimensions") {
    remove_dataset(p.b, "R_x");
    add_dataset(p.b, "R_x", {2, 3, 1});
    expected = "R_x: different shapes: 2 x 3 x 1 over ";
  }
  SECTION("status") {
    put(p.b, "status", {0, 1}, 1);
    expected = "k_r = 5, k_theta = 1: load_jump against ok  FAILED";
  }
  SECTION("no status") {
    remove_dataset(p.b, "status");
    expected = "status: only in reference/small.json";
  }
  SECTION("verdict") {
    p.reference["claims"][0]["verdict"] = "refuted";
    expected = "claim x \"falls\": supported, was refuted";
  }
  SECTION("fewer claims") {
    p.reference["claims"].push_back(p.reference["claims"][0]);
    expected = "different checks";
  }
  CHECK_FALSE(p.report().agree());
  CHECK_THAT(p.text(), Contains(expected));
}

TEST_CASE("deviations: a different number of passages is none, as it is cost") {
  const Pair p;
  put(p.b, "passages", {0, 0}, 9999);
  CHECK(p.report().differences.empty());
}

TEST_CASE("deviations: the file may have more points, but a missing point or axis is a failure") {
  const Scratch s;
  const std::string sweep =
      R"(, "sweep": {"k_r": {"values": [1, 5, 20]}, "k_theta": {"values": [0.3, 1, 3, 9]}})";
  small_experiment(s);
  const Experiment more = load_experiment(
      s.write("more.json", R"({"extends": "small.json", "name": "small")" + sweep + "}"), {{}, "full"});
  Json r = reference_of(small_result(s, "a.h5"));
  r["claims"][0]["verdict"] = "refuted";  // not compared between different points
  const auto same = [](std::size_t i, PointResult& p) {
    if (i / 4 >= 1 && i % 4 < 3) p = small_point((i / 4 - 1) * 3 + i % 4);
  };
  const std::string all = small_result(s, "b.h5", more, same);
  const Comparison report = compare_files(all, r);
  CHECK(report.agree());
  CHECK(report.points == 6);
  CHECK_THAT(comparison_text(report), Contains("6 of 12 points: the same, bit for bit"));
  CHECK_FALSE(compare_files(s.path("a.h5"), reference_of(all)).agree());  // not the other way round
  put(all, "R_x", {1, 2}, 7);
  CHECK(compare_files(all, r).differences.at(0).place == "k_r = 5, k_theta = 3");
  put(all, "k_r", {1}, 5.1);
  CHECK_THAT(compare_files(all, r).failures.at(0),
             Contains("k_r: different coordinates: 5 of reference/small.json is not among the 3 values"));
  const Experiment fewer_axes = load_experiment(
      s.write("fewer.json", R"({"extends": "small.json", "sweep": {"k_theta": null}})"), {{}, "full"});
  const std::string one = small_result(s, "c.h5", fewer_axes);
  CHECK_THAT(compare_files(all, reference_of(one)).failures.at(0), Contains("k_theta: only in"));
}

TEST_CASE("reference: a malformed file is refused with the JSON pointer of the mistake") {
  const Pair p;
  Json json = p.reference;
  json["variables"]["R_x"]["tolerance"] = {{1, 1, 1}, {1, 1, 1}};
  std::string expected;
  const auto refused = [&](const std::string& text) {
    CHECK_THROWS_WITH(read_reference(p.s.write("r.json", text)),
                      Contains("r.json: ") && Contains(expected) && Contains("restore the reference"));
    CHECK_THROWS_AS(read_reference(p.s.path("r.json")), InputError);
  };
  CHECK_NOTHROW(read_reference(p.s.write("r.json", json.dump())));
  const auto broken = [&](const std::string& pointer, const Json& value, const std::string& more = "") {
    Json copy = json;
    copy[JsonPointer(pointer)] = value;
    expected = pointer + more;
    refused(copy.dump());
  };
  broken("/schema", "bristle-reference/2");
  broken("/name", 1);
  broken("/numerics_version", "2");
  broken("/axes/k_r/0", nullptr);
  broken("/axes/k_r", Json::array());
  broken("/variables/R_x/values/1/2", "1.5");
  broken("/variables/R_x/values", {1, 2}, "/");
  broken("/variables/R_x/values", {{1, 2}}, ": 1 rows, but the axes have 2");
  broken("/variables/R_x/values/1", {1, 2, 3, 4}, ": 4 numbers, but there are 3");
  broken("/variables/R_n/tolerance", -1, ": -1 is not allowed");
  broken("/variables/R_n/tolerance", nullptr, ": is missing");
  broken("/variables/R_x/tolerance", {{1, 1, 1}, {1, -1, 1}});
  broken("/variables/R_x/tolerance/0", {1, 1}, ": 2 numbers, but there are 3");
  broken("/flags/status/1/1", 0.5);
  broken("/flags/status/1", {0, 0}, ": 2 numbers");
  broken("/claims/0/verdict", "suported", ": \"suported\" is not allowed (did you mean supported?)");
  broken("/variables/R_x", 1);
  broken("/flagz", 1, ": unknown key (did you mean flags?)");
  Json short_axis = json;
  short_axis["axes"]["k_r"] = {5};
  expected = "/flags/exceeds_R_c: 2 rows, but the axes have 1";
  refused(short_axis.dump());
  json["variables"]["R_x"].erase("tolerance");
  expected = "/variables/R_x/tolerance: is missing";
  refused(json.dump());
  expected = "not JSON";
  refused(json_lines(p.reference).substr(0, 500));
  refused("");
  expected = "expected a JSON object";
  refused("[1]");
}

}  // namespace bristle::reference_test
