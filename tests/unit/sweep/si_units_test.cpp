#include "experiment/experiment.hpp"
#include "experiment/si_units.hpp"
#include "scratch.hpp"

#include "catch.hpp"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

namespace bristle::si_units_test {
using namespace testing;

namespace {

const std::string kExperiments = BRISTLE_EXPERIMENTS;

}  // namespace

TEST_CASE("an SI block gives the dimensionless values of the paper") {
  const Experiment e = load_experiment(
      kExperiments + "/paper.json",
      {{R"(/si={"m_kg":1e-4,"r0_m":0.017,"V0_m_per_s":10,"R_c_m":0.001,"E_star_Pa":1.190476e8,"k_theta_N_m":0.01,
           "k_r_N_per_m":346.0207612})"},
       "full"});
  const Parameters& p = e.sweep.base.setup.parameters;
  CHECK(p.R_c == Approx(1.0 / 17));
  CHECK(p.E_star == Approx(5.849e4).epsilon(1e-3));
  CHECK(p.k_theta == Approx(1));
  CHECK(p.k_r == Approx(10));
}

TEST_CASE("an si block that is null, or that a file removes, leaves the bending and the contact") {
  const Scratch s;
  std::filesystem::copy_file(kExperiments + "/paper.json", s.path("paper.json"));
  const auto setup = [&](const std::string& more) {
    const std::string file = s.write("e.json", R"({"extends": "paper.json", "name": "e")" + more + "}");
    return load_experiment(file, {}).sweep.base.setup;
  };
  const Parameters without = setup("").parameters, null = setup(R"(, "si": null)").parameters;
  CHECK(null.bending == without.bending);
  CHECK(null.contact == without.contact);
}

TEST_CASE("a material in SI units has the same stiffness at every velocity") {
  const Experiment e = load_experiment(kExperiments + "/ski.json", {});
  // V0_m_per_s is the last axis: 13 values from 2 to 32.
  const PointInput slow = e.sweep.point(0), fast = e.sweep.point(12);
  const Parameters &a = slow.setup.parameters, &b = fast.setup.parameters;
  CHECK(slow.si.at("V0_m_per_s") == 2);
  CHECK(fast.si.at("V0_m_per_s") == 32);
  // 3 pi E R^4/(4 r0), computed here independently
  const double k = 3 * M_PI * 1e8 * std::pow(0.00108, 4) / (4 * 0.017);
  CHECK(a.k_phi * 1e-4 * 4 == Approx(k));
  CHECK(b.k_phi * 1e-4 * 1024 == Approx(k));
  CHECK(a.k_theta == a.k_phi);
  CHECK(a.bending == Bending::rod);
  CHECK(a.contact == Contact::hertz);
  CHECK(a.section == Section::round);
  CHECK(a.k_r == Approx(10 * a.k_phi));
  for (const auto member : {&Parameters::k_r, &Parameters::E_star, &Parameters::tau_f})
    CHECK(a.*member / (b.*member) == Approx(256));
  CHECK(a.V_s / b.V_s == Approx(16));
  CHECK(a.E_star * 1e-4 * 4 / std::pow(0.017, 3) == Approx(1e8 / (1 - 0.16)));
  CHECK(slow.loading.R_n * si_scales(slow).force == Approx(0.1));
  CHECK(fast.loading.R_n * si_scales(fast).force == Approx(0.1));
}

TEST_CASE("a density gives the mass of the first mode of bending, and a pressure the load of a bristle") {
  const Experiment e = load_experiment(
      kExperiments + "/ski.json",
      {{"/si/m_kg=null", "/si/rho_kg_per_m3=1100", "/si/spacing_m=0.004", "/sweep=null",
        R"(/sweep={"pressure_Pa": {"values": [1e4, 3e4]}, "R_m": {"values": [0.001, 0.0012]}})"},
       "full"});
  for (std::size_t i = 0; i < e.sweep.size(); ++i) {
    const PointInput point = e.sweep.point(i);
    const SiScales scales = si_scales(point);
    const double R = point.si.at("R_m"), r0 = point.si.at("r0_m"), V0 = point.si.at("V0_m_per_s");
    const double m = scales.energy / (V0 * V0), area = M_PI * R * R, I = M_PI * std::pow(R, 4) / 4;
    CAPTURE(R, m);
    // The lowest angular frequency of a clamped rod, from the root 1.8751 of its frequency equation.
    const double of_rod = 1.8751041 * 1.8751041 * std::sqrt(1e8 * I / (1100 * area * std::pow(r0, 4)));
    CHECK(std::sqrt(3 * 1e8 * I / (std::pow(r0, 3) * m)) == Approx(of_rod).epsilon(1e-6));
    CHECK(point.loading.R_n * scales.force == Approx(point.si.at("pressure_Pa") * 0.004 * 0.004));
  }
}

TEST_CASE("a measured polar stiffness replaces that of the shaft, and the ratios are to it") {
  const Experiment e = load_experiment(kExperiments + "/ski.json", {{"/si/k_phi_N_m=0.02"}, "full"});
  const PointInput point = e.sweep.point(0);
  const Parameters& p = point.setup.parameters;
  CHECK(p.k_phi * si_scales(point).energy == Approx(0.02));
  CHECK(p.k_r == Approx(10 * p.k_phi));
  CHECK(p.k_theta == p.k_phi);
  CHECK(p.R == Approx(0.00108 / 0.017));
}

TEST_CASE("gap, slab and spacing in metres follow the bristle's length") {
  Scratch s;
  std::filesystem::copy_file(kExperiments + "/paper.json", s.path("paper.json"));
  const Experiment e = load_experiment(s.write("e.json", R"({"extends": "paper.json", "name": "e",
    "load": {"R_n": null}, "si": {"m_kg": 1, "r0_m": 2, "V0_m_per_s": 1, "z_0_m": 1.2, "L_x_m": 7, "L_y_m": 3,
    "spacing_m": 0.5}, "sweep": {"r0_m": {"values": [2, 4]}}})"),
                                       {});
  for (const std::size_t i : {0, 1}) {
    const PointInput point = e.sweep.point(i);
    const double r0 = i == 0 ? 2 : 4;
    CHECK(*point.loading.z_0 == Approx(1.2 / r0));
    CHECK(point.setup.parameters.L_x == Approx(7 / r0));
    CHECK(point.setup.parameters.L_y == Approx(3 / r0));
    CHECK(point.setup.parameters.spacing == Approx(0.5 / r0));
  }
}

TEST_CASE("an SI block warns of values that it replaces, and of a load that is not in newtons") {
  Scratch s;
  std::filesystem::copy_file(kExperiments + "/ski.json", s.path("ski.json"));
  std::filesystem::copy_file(kExperiments + "/paper.json", s.path("paper.json"));
  const auto warnings = [&](const std::string& text, const std::vector<std::string>& set = {}) {
    return load_experiment(s.write("e.json", text), {set, "full"}).warnings;
  };
  // Inherited values are those of the paper, which an SI block is meant to replace.
  CHECK(warnings(R"({"extends": "ski.json", "name": "e"})").empty());
  const auto own = warnings(R"({"extends": "ski.json", "name": "e", "model": {"k_r": 7, "mu_c": 0.5}})");
  REQUIRE(own.size() == 1);
  CHECK(own[0] == s.path("e.json") +
                      ": /model/k_r: has no effect, because the si block replaces it by R_m and "
                      "k_r_over_k_phi");
  CHECK_THROWS_WITH(warnings(R"({"extends": "ski.json", "name": "e"})", {"/model/tau_f=1"}),
                    Catch::StartsWith("--set /model/tau_f=1: /model/tau_f: has no effect") &&
                        Catch::EndsWith("replaces it by tau_f_Pa; set that instead"));
  const auto load = warnings(
      R"({"extends": "ski.json", "name": "e", "load": {"R_n": 0.005}, "sweep": null, "tiers": null})");
  REQUIRE(load.size() == 1);
  // m V_0^2/r_0 at 10 m/s is 0.588 N.
  CHECK_THAT(load[0], Catch::Contains("/load/R_n: is in units of m V_0^2/r_0, 0.588 N at the first point"));
  CHECK(load_experiment(s.path("paper.json"), {{"/model/k_r=7"}, "full"}).warnings.empty());
  const Experiment stored =
      stored_experiment(*load_experiment(s.path("e.json"), {}).document, "full", "stored");
  CHECK(stored.warnings.size() == 1);  // of the load; a stored experiment states every value
}

TEST_CASE("values that look as if they were in another unit are warned of") {
  const auto warnings = [](const std::string& set) {
    return load_experiment(kExperiments + "/ski.json", {{set}, "full"}).warnings;
  };
  for (const auto& [set, found] : std::map<std::string, std::string>{
           {"/si/E_Pa=210", "/si/E_Pa: 210 is unusual, outside 10000 to 2e+12"},
           {"/si/r0_m=17", "/si/r0_m: 17 is unusual, outside 1e-06 to 1"}}) {
    CAPTURE(set);
    const auto all = warnings(set);
    const std::string whole = found + "; is it in the unit of the key?";
    CHECK(std::ranges::any_of(all, [&](const std::string& one) { return one.find(whole) != one.npos; }));
  }
  CHECK(warnings("/si/E_Pa=2.1e11").empty());
  const auto swept = warnings(R"(/sweep/V0_m_per_s={"values":[1,5000],"logspace":null})");
  REQUIRE(swept.size() == 1);
  CHECK_THAT(swept[0], Catch::Contains("/sweep/V0_m_per_s: 5000 is unusual"));
}

TEST_CASE("a number that --set gives and that no point depends on is warned of") {
  const auto warnings = [](const std::string& friction, const std::string& set) {
    return load_experiment(kExperiments + "/paper.json", {{"/model/friction=" + friction, set}, "full"})
        .warnings;
  };
  const auto idle = warnings("nss", "/model/mu_c=0.5");
  REQUIRE(idle.size() == 1);
  CHECK_THAT(idle[0],
             Catch::Contains("--set /model/mu_c=0.5: /model/mu_c: has no effect with these choices"));
  CHECK(warnings("coulomb", "/model/mu_c=0.5").empty());
  CHECK(warnings("nss", "/model/tau_f=7").empty());
  CHECK(warnings("nss", "/orientation/rtol=0.1").empty());
  CHECK(warnings("nss", "/orientation/mean_deg=30").size() == 1);  // of a uniform distribution
  CHECK(warnings("nss", "/model/section=oval").size() == 1);       // of bristles with polar springs
  CHECK(warnings("nss", "/model/bending=rod").empty());
}

TEST_CASE(
    "shafts that overlap are refused, and shafts that are not slender warned of, with the value's place") {
  Scratch s;
  for (const char* file : {"ski.json", "paper.json"})
    std::filesystem::copy_file(kExperiments + std::string("/") + file, s.path(file));
  const auto warnings = [&](const std::vector<std::string>& set) {
    return load_experiment(s.path("ski.json"), {set, "full"}).warnings;
  };
  const std::string thick =
      "r_0 is thick; the formulas of a slender rod (stiffnesses, strain at the root) are accurate up to 0.1 "
      "r_0";
  const std::string remedy = "; give a larger spacing or thinner shafts";
  CHECK(warnings({"/si/R_m=0.0017", "/si/spacing_m=0.0034"}).empty());  // shafts that touch, of radius r_0/10
  CHECK_THROWS_WITH(
      warnings({"/si/spacing_m=0.0017"}),
      "--set /si/spacing_m=0.0017: /si/spacing_m: shafts overlap: their spacing, 1.7 mm, is less than "
      "their diameter 2 R, 2.16 mm" +
          remedy);
  const std::string sweep = R"(/sweep/R_m={"values":[0.001,0.00171]})";
  CHECK_THROWS_WITH(warnings({sweep}),
                    Catch::Contains("shafts overlap at") && Catch::Contains("R_m = 0.00171") &&
                        Catch::Contains("3.4 mm, is less than their diameter 2 R, 3.42 mm"));
  CHECK_THROWS_WITH(
      load_experiment(s.path("paper.json"), {{"/model/spacing=0.019", "/model/R=0.01"}, "full"}),
      Catch::EndsWith("/model/spacing: shafts overlap: their spacing, 0.019 r_0, is less than their diameter "
                      "2 R, 0.02 r_0" +
                      remedy));
  const std::string sample =
      R"(/sweep/sample={"sobol":2,"seed":1,"over":{"R_m":{"values":[0.0016,0.00171]}}})";
  CHECK(warnings({sample, "/si/spacing_m=0.01"}) ==
        std::vector<std::string>{"--set " + sample + ": /sweep/sample/over/R_m: 0.1006 " + thick});
}

}  // namespace bristle::si_units_test
