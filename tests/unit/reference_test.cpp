#include "compare/deviation_text.hpp"
#include "compare/reference_file.hpp"
#include "compare/replay.hpp"
#include "util/error.hpp"
#include "small_result.hpp"

#include "catch.hpp"

namespace bristle::reference_test {
using namespace testing;
using Catch::Contains;

namespace {

template <class Quantities>
auto& named(Quantities& all, const std::string& name) {
  for (auto& q : all)
    if (q.name == name) return q;
  throw std::out_of_range(name);
}

// A result, its reference, and a copy of the result, which tests change.
struct Pair {
  Scratch s;
  std::string a = small_result(s, "a.h5"), b = small_result(s, "b.h5");
  Reference reference = reference_of(a);

  DeviationReport report() const { return compare_with_reference(reference, reference_of(b)); }
  std::string text() const { return deviation_text(report(), ResultReader(b), "reference/small.json"); }
  // Changes R_x at k_r = 20, k_theta = 0.3 by the given number of its tolerances.
  void move_R_x(double tolerances) const {
    const ReferenceVariable& v = named(reference.variables, "R_x");
    put(b, "R_x", {1, 0}, v.values[3] + tolerances * v.tolerance(3));
  }
};

}  // namespace

TEST_CASE("reference: its content and the parts of its tolerances") {
  const Scratch s;
  const std::string file = small_result(s, "a.h5");
  put(file, "load_error/R_x", {0, 0}, 4e-4);
  put(file, "load_error/R_x", {0, 1}, 1);
  const Reference r = reference_of(file);
  CHECK(r.axes.at(0).name == "k_r");
  CHECK(r.axes.at(1).values == std::vector<double>{0.3, 1, 3});
  CHECK(r.flags.at(0).values == std::vector<long>(6, 0));
  CHECK(r.claims.at(0).verdict == "supported");
  for (const ReferenceVariable& v : r.variables) {
    CHECK(v.name != "passages");
    CHECK(v.name.find("_err") == std::string::npos);
  }
  const ReferenceVariable& R_x = named(r.variables, "R_x");
  const double scale = small_point(5).value[bristle::R_X];
  CHECK(R_x.load_control[0] == 4e-4);
  CHECK(R_x.quadrature[0] == Approx(6e-4));
  CHECK(R_x.quadrature[1] == 0);  // the load's part is larger than the whole
  CHECK(R_x.integrator[0] == Approx(10 * 3e-5 * scale));
  CHECK(R_x.libm[0] == Approx(1e-3 + 1e-8 * scale));
  CHECK(R_x.tolerance(0) == Approx(2e-3 + (3e-4 + 1e-8) * scale));
  const ReferenceVariable &R_n = named(r.variables, "R_n"), &pinned = named(r.variables, "pinned_fraction");
  CHECK(R_n.load_control[0] == Approx(1e-3 * 2));  // orientation.rtol of the target
  CHECK(pinned.libm[0] == Approx(3 * pinned.quadrature[0]).margin(1e-7));
  CHECK(named(r.variables, "jump_z_0").tolerance(0) == 0);
}

TEST_CASE("reference: a file that is read and written again is unchanged") {
  const Pair p;
  const std::string text = reference_text(p.reference);
  CHECK(text.back() == '\n');
  CHECK(reference_text(read_reference(p.s.write("r.json", text))) == text);
  CHECK_THAT(text, Contains("\"jump_z_0\": {\n   \"values\": [null,null,null,null,null,null],\n"));
}

TEST_CASE("deviations: none, above half a tolerance, and above the tolerance") {
  const Pair p;
  CHECK_FALSE(p.report().failed());
  CHECK(p.report().deviations.empty());
  CHECK_THAT(p.text(), Contains("the same, bit for bit"));
  p.move_R_x(0.6);
  CHECK_FALSE(p.report().failed());
  CHECK(p.report().deviations.at(0).tolerances == Approx(0.6));
  CHECK_THAT(p.text(), Contains("above half its tolerance") && Contains("k_r = 20, k_theta = 0.3"));
  p.move_R_x(-1.5);
  CHECK(p.report().failed());
  CHECK(p.report().deviations.at(0).tolerances == Approx(1.5));
  CHECK_THAT(p.text(), Contains("FAILED"));
  CHECK_THAT(p.text(),
             Contains(R"(build/bristle run experiments/small.json --tier smoke --set )"
                      R"('/sweep/k_r={"values":[20.0],"logspace":null,"linspace":null,"take":null}' )"
                      R"(--set '/sweep/k_theta={"values":[0.3],)"));
}

TEST_CASE("replay: the command names the experiment file of the run and the changes by --set") {
  const Scratch s;
  small_experiment(s);
  const Experiment changed = load_experiment(
      s.path("small.json"), {{"/model/k_phi=2.5", R"(/load={"z_0":0.5,"R_n":null})"}, "full"});
  const std::string file = small_result(s, "a.h5", changed);
  {
    const h5::Handle opened = h5::open_file(file, true);
    const h5::Handle group(H5Gopen2(opened, "provenance", H5P_DEFAULT), H5Gclose, "opening /provenance");
    h5::write_attribute(group, "command_line", "bristle run " + s.path("small.json") + " -o a.h5");
  }
  const std::string command = replay_command(ResultReader(file), 4);
  CHECK_THAT(command, Contains("build/bristle run " + s.path("small.json") + " --set /model/k_phi=2.5 ") &&
                          Contains("--set /load/z_0=0.5 --set /load/R_n=null ") && !Contains("--tier"));
  CHECK_THAT(command,
             Contains(R"('/sweep/k_r={"values":[20.0],)") && Contains(R"('/sweep/k_theta={"values":[1.0],)"));
}

TEST_CASE("replay: words of choices, any node of a traced curve, and no checks, as one point has none") {
  const Scratch s;
  small_experiment(s);
  const Experiment curves =
      load_experiment(s.write("curves.json", R"({"extends": "small.json", "name": "curves",
        "load": {"R_n": null, "path": null, "trace": {"nodes": 96}},
        "sweep": {"k_theta": null, "friction": {"values": ["nss", "coulomb"]}}})"),
                      {});
  ResultWriter writer(curves, s.path("a.h5"));
  for (std::size_t i = 0; i < curves.points(); ++i) writer.write(i, record_of(curves, {CurveNode{}}));
  writer.close({{"command_line", "bristle run " + s.path("curves.json")}});
  writer.publish();
  const std::string command = replay_command(ResultReader(s.path("a.h5")), 2 * 96 + 5);
  CHECK_THAT(command, Contains(R"('/sweep/k_r={"values":[20.0],)") &&
                          Contains(R"('/sweep/friction={"values":["nss"],)") &&
                          Contains("--set /checks=null"));
}

TEST_CASE("deviations: listed in descending order, at most 25 of them") {
  const Pair p;
  for (hsize_t i = 0; i < 2; ++i)
    for (hsize_t j = 0; j < 3; ++j)
      for (const char* name : {"R_x", "R_n", "gamma_1", "gamma_2", "gamma_3"})
        put(p.b, name, {i, j}, double(10 * i + j) + 0.05);
  const DeviationReport report = p.report();
  CHECK(report.above(1) == 30);
  for (std::size_t i = 1; i < report.deviations.size(); ++i)
    CHECK(report.deviations[i - 1].tolerances >= report.deviations[i].tolerances);
  CHECK_THAT(p.text(), Contains("and 5 more above half their tolerances") && Contains("FAILED: 30 above"));
}

TEST_CASE("deviations: NaN and infinity fail, in either direction") {
  const Pair p;
  SECTION("a value was lost") { put(p.b, "R_x", {1, 2}, kNone); }
  SECTION("infinite") { put(p.b, "R_x", {1, 2}, INFINITY); }
  SECTION("a new value") { put(p.b, "jump_z_0", {1, 2}, 0.5); }
  CHECK(p.report().failed());
  CHECK(p.report().deviations.at(0).tolerances == INFINITY);
  CHECK_THAT(p.text(), Contains("k_r = 20, k_theta = 3  FAILED"));
}

TEST_CASE("deviations: missing and extra variables and different shapes, status and verdicts are failures") {
  Pair p;
  std::string expected;
  SECTION("missing") {
    remove_dataset(p.b, "R_x");
    expected = "R_x: missing in the file";
  }
  SECTION("extra") {
    add_dataset(p.b, "gamma_4", {2, 3});
    expected = "gamma_4: not in the reference";
  }
  SECTION("shape") {
    remove_dataset(p.b, "R_x");
    add_dataset(p.b, "R_x", {6});
    expected = "R_x: different shape: (6)";
  }
  SECTION("dimensions") {
    remove_dataset(p.b, "R_x");
    add_dataset(p.b, "R_x", {2, 3, 1});
    expected = "R_x: different shape: (2, 3, 1)";
  }
  SECTION("status") {
    put(p.b, "status", {0, 1}, 1);
    expected = "ok                load_jump  k_r = 5, k_theta = 1  FAILED";
  }
  SECTION("no status") {
    remove_dataset(p.b, "status");
    expected = "status: missing";
  }
  SECTION("verdict") {
    p.reference.claims[0].verdict = "refuted";
    expected = "claim x \"falls\": supported, was refuted";
  }
  SECTION("fewer claims") {
    p.reference.claims.push_back({"y", "", "rises", "supported"});
    expected = "different checks";
  }
  CHECK(p.report().failed());
  CHECK_THAT(p.text(), Contains(expected));
}

TEST_CASE("deviations: a different number of passages is none, as it is cost") {
  const Pair p;
  put(p.b, "passages", {0, 0}, 9999);
  CHECK_FALSE(p.report().failed());
}

TEST_CASE("deviations: the file may have more points, but a missing point or axis is a failure") {
  const Scratch s;
  const std::string sweep =
      R"(, "sweep": {"k_r": {"values": [1, 5, 20]}, "k_theta": {"values": [0.3, 1, 3, 9]}})";
  small_experiment(s);
  const Experiment more = load_experiment(
      s.write("more.json", R"({"extends": "small.json", "name": "small")" + sweep + "}"), {{}, "full"});
  Reference r = reference_of(small_result(s, "a.h5"));
  r.claims[0].verdict = "refuted";  // not compared between different points
  const auto same = [](std::size_t i, PointResult& p) {
    if (i / 4 >= 1 && i % 4 < 3) p = small_point((i / 4 - 1) * 3 + i % 4);
  };
  const std::string all = small_result(s, "b.h5", more, same);
  const DeviationReport report = compare_with_reference(r, reference_of(all));
  CHECK_FALSE(report.failed());
  CHECK(report.points == 6);
  CHECK_THAT(deviation_text(report, ResultReader(all), "r.json"), Contains("6 of 12 points"));
  put(all, "k_r", {1}, 5.1);
  CHECK_THAT(compare_with_reference(r, reference_of(all)).failures.at(0),
             Contains("k_r = 5 of the reference is not among"));
  r.axes.pop_back();
  CHECK_THAT(compare_with_reference(r, reference_of(all)).failures.at(0), Contains("different axes"));
}

TEST_CASE("reference: a malformed file is refused with the JSON pointer of the mistake") {
  const Pair p;
  Json json = Json::parse(reference_text(p.reference));
  std::string expected;
  const auto refused = [&](const std::string& text) {
    CHECK_THROWS_WITH(read_reference(p.s.write("r.json", text)), Contains("r.json: ") && Contains(expected));
    CHECK_THROWS_AS(read_reference(p.s.path("r.json")), InputError);
  };
  const auto broken = [&](const std::string& pointer, const Json& value) {
    Json copy = json;
    copy[JsonPointer(pointer)] = value;
    expected = pointer;
    refused(copy.dump());
  };
  broken("/schema", "bristle-reference/2");
  broken("/name", 1);
  broken("/numerics_version", "2");
  broken("/axes/k_r/0", nullptr);
  broken("/variables/R_x/values/2", "1.5");
  broken("/variables/R_x/values", {1, 2});
  broken("/variables/R_x/libm", -1);
  broken("/variables/R_x/quadrature", nullptr);
  broken("/variables/R_x/quadrature", {1, 2});
  broken("/flags/status/values/1", 0.5);
  broken("/claims/0/verdict", "suported");
  broken("/variables/R_x", 1);
  broken("/flagz", 1);
  Json short_axis = json;
  short_axis["axes"]["k_r"] = {5};
  expected = "/flags/status/values: 6 entries, but the axes have 3 points";
  refused(short_axis.dump());
  json["variables"]["R_x"].erase("quadrature");
  expected = "/variables/R_x/quadrature: is missing";
  refused(json.dump());
  expected = "not JSON";
  refused(reference_text(p.reference).substr(0, 500));
  refused("");
  expected = "is not an object";
  refused("[1]");
}

}  // namespace bristle::reference_test
