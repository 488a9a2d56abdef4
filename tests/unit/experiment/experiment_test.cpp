#include "experiment/experiment.hpp"
#include "scratch.hpp"

#include "catch.hpp"
#include <algorithm>
#include <cmath>
#include <filesystem>

namespace bristle::experiment_test {
using namespace testing;

namespace {

const std::string kExperiments = BRISTLE_EXPERIMENTS;

}  // namespace

TEST_CASE("the points of each smoke tier are points of the full tier, with which references are compared") {
  for (const auto& file : std::filesystem::directory_iterator(BRISTLE_EXPERIMENTS)) {
    if (file.path().extension() != ".json") continue;
    CAPTURE(file.path());
    const Experiment full = load_experiment(file.path(), {}),
                     smoke = load_experiment(file.path(), {{}, "smoke"});
    if (!smoke.ranges.empty()) continue;  // the trials of another search
    REQUIRE(smoke.sweep.axes.size() == full.sweep.axes.size());
    for (std::size_t d = 0; d < smoke.sweep.axes.size(); ++d) {
      CHECK(smoke.sweep.axes[d].name == full.sweep.axes[d].name);
      for (const double value : smoke.sweep.axes[d].values)
        CHECK(std::ranges::count(full.sweep.axes[d].values, value) == 1);
    }
  }
}

TEST_CASE("extends: chains, subfolders, and files outside the experiments folder") {
  Scratch s;
  s.write("experiments/paper.json", bytes_of(kExperiments + "/paper.json"));
  const auto child =
      s.write("experiments/more/a.json", R"({"extends": "../paper.json", "model": {"k_r": 7}})");
  CHECK(load_experiment(child, {}).sweep.base.setup.parameters.k_r == 7);
  const auto grandchild =
      s.write("experiments/more/b.json", R"({"extends": "a.json", "model": {"k_phi": 3}})");
  const Experiment e = load_experiment(grandchild, {});
  CHECK(e.sweep.base.setup.parameters.k_r == 7);
  CHECK(e.sweep.base.setup.parameters.k_phi == 3);
  s.write("outside.json", "{}");
  const auto outside = s.write("experiments/c.json", R"({"extends": "../outside.json"})");
  CHECK_THROWS_WITH(load_experiment(outside, {}), Catch::Contains("lies outside the experiments folder"));
  s.write("experiments/d.json", R"({"extends": "e.json"})");
  const auto circle = s.write("experiments/e.json", R"({"extends": "d.json"})");
  CHECK_THROWS_WITH(load_experiment(circle, {}), Catch::Contains("extends this file in turn"));
  CHECK_THROWS_WITH(load_experiment(s.path("nothing.json"), {}),
                    Catch::EndsWith("cannot be read: no such file"));
}

TEST_CASE("the option --set changes elements of arrays, and refuses pointers to nothing") {
  const auto changed = [](std::vector<std::string> changes) {
    changes.insert(changes.begin(), {R"(/load={"R_n":null,"path":null,"z_0":0.5})",
                                     R"(/orientation={"sampling":"list","theta_0_deg":[10,100,170]})"});
    std::vector<double> degrees;
    for (const double theta_0 : load_experiment(kExperiments + "/paper.json", {changes, "full"})
                                    .sweep.base.setup.orientation.theta_0)
      degrees.push_back(std::round(theta_0 * 180 / M_PI));
    return degrees;
  };
  CHECK(changed({"/orientation/theta_0_deg/0=20"}) == std::vector<double>{20, 100, 170});
  CHECK(changed({"/orientation/theta_0_deg/2=20"}) == std::vector<double>{10, 100, 20});
  CHECK(changed({"/orientation/theta_0_deg/-=20"}) == std::vector<double>{10, 100, 170, 20});
  CHECK(changed({"/orientation/theta_0_deg=[20]"}) == std::vector<double>{20});
  CHECK_THROWS_WITH(changed({"/orientation/theta_0_deg/3=20"}),
                    Catch::Contains("allowed: 0 to 2, or - to append"));
  CHECK_THROWS_WITH(changed({"/orientation/theta_0_deg/first=20"}),
                    Catch::Contains("not an element of the array"));
  CHECK_THROWS_WITH(
      changed({"/orientation/theta_0_deg/1=\"x\""}),
      Catch::StartsWith("--set /orientation/theta_0_deg/1=\"x\": /orientation/theta_0_deg/1: "));
  CHECK_THROWS_WITH(changed({"/modle/k_r=3"}), Catch::Contains("did you mean model?"));
  CHECK_THROWS_WITH(changed({"/model/k_rr=null"}), Catch::Contains("did you mean k_r?"));
  CHECK_THROWS_WITH(changed({"/name/k_r=3"}), Catch::Contains("does not exist"));
  CHECK_THROWS_WITH(changed({"/tiers/full/model/k_r=3"}), Catch::Contains("would have no effect"));
}

TEST_CASE(
    "axes: requested values, exact ends, and a smoke tier that is a subset of the full tier bit for bit") {
  const Experiment full = load_experiment(kExperiments + "/fig4.json", {});
  const Experiment smoke = load_experiment(kExperiments + "/fig4.json", {{}, "smoke"});
  REQUIRE(full.sweep.axes.size() == 3);
  CHECK(full.sweep.axes[0].name == "bending");
  CHECK(full.sweep.size() == 2400);
  const std::vector<double>& k_r = full.sweep.axes[1].values;
  CHECK(k_r.front() == 5);
  CHECK(k_r.back() == 100);
  for (std::size_t i = 1; i < 40; ++i) CHECK(k_r[i] / k_r[i - 1] == Approx(std::pow(100.0 / 5, 1.0 / 39)));
  for (std::size_t d = 0; d < 3; ++d)
    for (const double value : smoke.sweep.axes[d].values)
      CHECK(std::count(full.sweep.axes[d].values.begin(), full.sweep.axes[d].values.end(), value) == 1);
}

TEST_CASE("points are in row-major order over the axes, and C follows A if chi is to peak at V_s") {
  const Experiment e =
      load_experiment(kExperiments + "/paper.json",
                      {{R"(/sweep/A={"values":[1.2,1.5]})", R"(/sweep/R_n={"values":[1,2,3]})"}, "full"});
  CHECK(e.sweep.size() == 6);
  const PointInput p = e.sweep.point(4);
  CHECK(p.setup.parameters.A == 1.5);
  CHECK(p.loading.R_n == 2);
  CHECK(p.setup.parameters.C == Approx(chi_C_peak_at_V_s(1.5)));
  CHECK(e.sweep.point(0).setup.parameters.C == Approx(chi_C_peak_at_V_s(1.2)));
}

TEST_CASE("the local friction is the friction of rigid bristles over their load, under every law") {
  const Scratch s;
  s.write("paper.json", bytes_of(kExperiments + "/paper.json"));
  const std::string sweep = R"("nominal_friction": {"values": [0.5, 6.1984]}, "R_n": {"values": [0.3, 2]})";
  const Experiment e = load_experiment(
      s.write(
          "e.json",
          R"({"extends": "paper.json", "name": "e", "friction_law": {"V_R": [0, 1, 2], "mu": [0, 0.3, 0.2], "between": "linear"},
          "sweep": {"friction": {"values": )" +
              Json(texts(words<FrictionLaw>())).dump() + "}, " + sweep + "}}"),
      {});
  for (std::size_t i = 0; i < e.sweep.size(); ++i) {
    const PointInput point = e.sweep.point(i);
    const double nominal = rigid_friction(point.setup.parameters, point.loading.R_n) / point.loading.R_n;
    CHECK(nominal == Approx(*point.nominal_friction).epsilon(1e-14));
  }
  CHECK(e.sweep.point(3).setup.parameters.tau_f == Approx(3e4).epsilon(1e-5));  // the paper's, at R_n = 2
  CHECK(e.sweep.point(7).setup.parameters.mu_c == 6.1984);
}

TEST_CASE("a tier removes keys by null, and an extending experiment can remove the tier of its parent") {
  Scratch s;
  s.write("experiments/paper.json", bytes_of(kExperiments + "/paper.json"));
  const auto parent = s.write("experiments/a.json", R"({"extends": "paper.json", "name": "a",
    "tiers": {"smoke": {"load": {"R_n": null, "path": null, "z_0": 0.5}}}})");
  CHECK(load_experiment(parent, {{}, "smoke"}).sweep.base.loading.z_0 == 0.5);
  CHECK_FALSE(load_experiment(parent, {}).sweep.base.loading.z_0);
  const auto child = s.write("experiments/b.json", R"({"extends": "a.json", "tiers": {"smoke": null}})");
  CHECK_FALSE(load_experiment(child, {{}, "smoke"}).sweep.base.loading.z_0);
}

TEST_CASE("a change by --set concerns the chosen tier, also where another tier lacks the key") {
  Scratch s;
  s.write("experiments/paper.json", bytes_of(kExperiments + "/paper.json"));
  const auto file =
      s.write("experiments/a.json", R"({"extends": "paper.json", "name": "a", "load": {"path": "loading"},
    "sweep": {"k_r": {"values": [5, 10]}}, "locate_jumps": "k_r", "tiers": {"study": {"locate_jumps": null}}})");
  CHECK(load_experiment(file, {}).locate_jumps == "k_r");
  CHECK(load_experiment(file, {{"/locate_jumps=null"}, "full"}).locate_jumps.empty());
}

TEST_CASE("an inherited tier that does not fit is named with the patch that replaces it") {
  const Scratch s;
  for (const char* name : {"paper.json", "ski.json"})
    s.write(std::string("experiments/") + name, bytes_of(std::string(BRISTLE_EXPERIMENTS) + "/" + name));
  const auto loaded = [&](const std::string& more, const std::string& tier) {
    return load_experiment(
        s.write("experiments/my.json", R"({"extends": "ski.json", "name": "my", "title": "t",
      "sweep": {"R_n_N": {"values": [0.3, 0.6]}})" +
                                           more + "}"),
        {{}, tier});
  };
  const std::string advice = R"("tiers": {"smoke": null})";
  const auto check_advice = [&](const std::string& message) {
    CHECK_THAT(message, Catch::Contains(
                            "ski.json (tier smoke): /sweep/R_n_N/take: 2 is not allowed; allowed: ascending "
                            "indices from 0 to 1") &&
                            Catch::Contains("the tier smoke is inherited from ") && Catch::EndsWith(advice));
  };
  check_advice(loaded("", "full").warnings.back());
  try {
    loaded("", "smoke");
    FAIL("the tier that was asked for is not refused");
  } catch (const InputError& e) {
    check_advice(e.what());
  }
  CHECK(loaded("," + advice, "full").sweep.size() == 2 * 2 * 13);
  CHECK(loaded("," + advice, "smoke").sweep.size() == 2 * 2 * 13);
  CHECK(loaded(R"(, "tiers": {"smoke": {"sweep": {"R_n_N": {"take": [1]}}}})", "smoke").sweep.size() ==
        2 * 4);
  const std::string own = R"(, "tiers": {"smoke": {"model": {"mu_c": 0.5}}})";
  CHECK_THROWS_WITH(loaded(own, "smoke"),
                    Catch::EndsWith("change this key in /tiers/smoke of " + s.path("experiments/my.json") +
                                    "; null there removes it"));
  CHECK(loaded(R"(, "tiers": {"smoke": {"sweep": {"R_n_N": {"take": null}}}})", "smoke").sweep.size() ==
        2 * 2 * 4);
  // A mistake that every tier has is no fault of the tier.
  CHECK_THROWS_WITH(loaded(R"(, "model": {"mu_c": -1})", "smoke"), !Catch::Contains("inherited"));
}

TEST_CASE("a mistake in a tier stops only those who ask for it") {
  const Scratch s;
  s.write("paper.json", bytes_of(kExperiments + "/paper.json"));
  const struct {
    std::string changes, set, message;
  } cases[] = {
      {R"("tiers": {"smoke": {"model": {"k_r": -1}}})", "",
       "e.json (tier smoke): /model/k_r: -1 is not allowed; allowed: a number greater than 0"},
      {R"("sweep": {"sample": {"table": {"columns": ["k_r"], "rows": [[1], [2]]}}},
          "tiers": {"smoke": {"sweep": {"k_r": {"values": [1]}}}})",
       "", "e.json: /sweep/sample: k_r is varied by another axis, too; remove one of them"},
      {R"("sweep": {"k_r": {"values": [5, 10]}}, "tiers": {"smoke": {"load": {"z_0": 0.5}}})", "/load/R_n=3",
       "/load: R_n and z_0 are both given"},
  };
  for (const auto& [changes, set, message] : cases) {
    CAPTURE(changes);
    const std::string file = s.write("e.json", R"({"extends": "paper.json", "name": "e", )" + changes + "}");
    const std::vector<std::string> options = set.empty() ? std::vector<std::string>{} : std::vector{set};
    CHECK_THROWS_WITH(load_experiment(file, {options, "smoke"}), Catch::Contains(message));
    const Experiment full = load_experiment(file, {options, "full"});
    REQUIRE(full.warnings.size() == 1);
    CHECK_THAT(full.warnings[0],
               Catch::StartsWith("the tier smoke cannot be computed: ") && Catch::Contains(message));
  }
}

TEST_CASE("a change of how the values of an axis are given replaces the values that it had") {
  const Scratch s;
  s.write("paper.json", bytes_of(kExperiments + "/paper.json"));
  s.write("parent.json", R"({"extends": "paper.json", "name": "parent",
    "sweep": {"R_n": {"linspace": [1, 3, 5], "take": [0, 4]}, "k_r": {"values": [5, 10]}},
    "tiers": {"smoke": {"sweep": {"k_r": {"take": [1]}}}}})");
  const auto values = [&](const std::string& sweep, const std::vector<std::string>& set,
                          const std::string& tier = "full") {
    const std::string file =
        s.write("e.json", R"({"extends": "parent.json", "name": "e", "sweep": )" + sweep + "}");
    const Sweep read = load_experiment(file, {set, tier}).sweep;
    return std::pair(read.axes[read.axis_number("k_r")].values, read.axes[read.axis_number("R_n")].values);
  };
  using Pair = std::pair<std::vector<double>, std::vector<double>>;
  const Pair changed = {{5, 10}, {1.5}};
  CHECK(values("{}", {}) == Pair{{5, 10}, {1, 3}});
  CHECK(values("{}", {R"(/sweep/R_n={"values":[1.5]})"}) == changed);
  CHECK(values("{}", {R"(/sweep={"R_n":{"values":[1.5]}})"}) == changed);
  CHECK(values("{}", {"/sweep/R_n/values=[1.5]"}) == changed);
  CHECK(values("{}", {"/sweep/R_n/values=[1.5]", "/sweep/R_n/linspace=null", "/sweep/R_n/take=null"}) ==
        changed);
  CHECK(values(R"({"R_n": {"values": [1.5]}})", {}) == changed);
  CHECK(values(R"({"R_n": {"values": [1.5], "linspace": null, "take": null}})", {}) == changed);
  CHECK(values(R"({"R_n": {"take": [1]}})", {}) == Pair{{5, 10}, {1.5}});
  CHECK(values("{}", {R"(/sweep/k_r={"logspace":[10,1000,3]})"}, "smoke") == Pair{{10, 100, 1000}, {1, 3}});
  CHECK_THROWS_WITH(values(R"({"R_n": {"values": [1.5], "linspace": [1, 3, 5]}})", {}),
                    Catch::Contains("found values and linspace"));
  CHECK_THROWS_WITH(values("{}", {"/sweep/R_n/values=[1.5]", "/sweep/R_n/logspace=[1,3,5]"}),
                    Catch::Contains("found values and logspace"));
}

}  // namespace bristle::experiment_test
