#include "experiment/experiment.hpp"
#include "experiment/si_units.hpp"
#include "model/friction/laws.hpp"
#include "util/error.hpp"
#include "scratch.hpp"

#include "catch.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <filesystem>

namespace bristle::experiment_test {
using namespace testing;

namespace {

const std::string kExperiments = BRISTLE_EXPERIMENTS;

// The error message of this experiment in a folder with a copy of paper.json; the folder's name is replaced
// by "@".
std::string error_of(const std::string& text, const DocumentOptions& options = {}) {
  Scratch s;
  std::filesystem::copy_file(kExperiments + "/paper.json", s.path("paper.json"));
  const std::string file = s.write("e.json", text);
  try {
    load_experiment(file, options);
  } catch (const InputError& e) {
    std::string message = e.what();
    const std::string folder = s.path("");
    for (auto at = message.find(folder); at != std::string::npos; at = message.find(folder))
      message.replace(at, folder.size(), "@/");
    return message;
  }
  return "(no error)";
}

std::string laws() { return fmt::format("{}", fmt::join(texts(words<FrictionLaw>()), ", ")); }
std::string quoted_laws() { return fmt::format("\"{}\"", fmt::join(texts(words<FrictionLaw>()), "\", \"")); }

std::string with(const std::string& members) { return R"({"extends": "paper.json", )" + members + "}"; }

}  // namespace

TEST_CASE("the points of each smoke tier are points of the full tier, with which references are compared") {
  for (const auto& file : std::filesystem::directory_iterator(BRISTLE_EXPERIMENTS)) {
    if (file.path().extension() != ".json") continue;
    CAPTURE(file.path());
    const Experiment full = load_experiment(file.path(), {}), smoke = load_experiment(file.path(), {{}, "smoke"});
    if (smoke.design) continue;  // the trials of another search
    REQUIRE(smoke.axes.size() == full.axes.size());
    for (std::size_t d = 0; d < smoke.axes.size(); ++d) {
      CHECK(smoke.axes[d].name == full.axes[d].name);
      for (const double value : smoke.axes[d].values) CHECK(std::ranges::count(full.axes[d].values, value) == 1);
    }
  }
}

TEST_CASE("malformed experiments: the message names file, place, value and what is allowed") {
  struct Row {
    std::string text, message;
  };
  const std::vector<Row> table = {
      {"{ \"schema\": ",
       "@/e.json: not JSON: parse error at line 1, column 13: syntax error while parsing value - "
       "unexpected end of input; expected '[', '{', or a literal"},
      {"[1]", "@/e.json: expected a JSON object {...}, found [1]"},
      {with(R"("model": {"k_r": 1, "k_r": 2})"), "@/e.json: the key \"k_r\" appears twice in one object"},
      {with(R"("schema": "bristle-experiment/2")"),
       "@/e.json: /schema: \"bristle-experiment/2\" is not allowed; allowed: \"bristle-experiment/1\" "
       "(version of "
       "this format)"},
      {with(R"("modle": {})"),
       "@/e.json: /modle: unknown key (did you mean model?); allowed: schema, name, title, notes, figure, "
       "institution, model, si, friction_law, load, orientation, integrator, sweep, locate_jumps, analysis, design, record, "
       "trajectories, tiers, checks, "
       "checks_for_each"},
      {with(R"("orientation": {"sampling": "list", "theta_0_deg": {"random": 0, "seed": 1}})"),
       "@/e.json: /orientation/theta_0_deg/random: 0 is not allowed; allowed: an integer at least 1 and at "
       "most 100000 (number of azimuths)"},
      {with(R"("locate_jumps": "k_r")"),
       "@/e.json: /locate_jumps: \"k_r\" is not a number that the sweep varies; allowed: a number in /sweep"},
      {with(R"("locate_jumps": "friction", "sweep": {"friction": {"values": ["nss"]}})"),
       "@/e.json: /locate_jumps: \"friction\" is not a number that the sweep varies; allowed: a number in "
       "/sweep"},
      {with(
           R"("locate_jumps": "k_r", "sweep": {"k_r": {"values": [1, 2]}}, "load": {"R_n": null, "z_0": 0.5})"),
       "@/e.json: /locate_jumps: needs a load R_n: at a given gap, and along a traced curve, no gap jumps"},
      {with(R"("model": {"k_tehta": 1})"),
       "@/e.json: /model/k_tehta: unknown key (did you mean k_theta?); allowed: friction, bending, "
       "initial_state, pole_rule, k_r, k_theta, k_phi, phi_0_deg, zeta_theta, zeta_phi, mu_c, tau_f, R_c, "
       "E_star, "
       "A, C, V_s, lambda, lambda_z, alpha, beta, s_min, L_x, L_y, spacing, R, "
       "strain_limit, stretch_limit"},
      {with(R"("model": {"k_r": "ten"})"),
       "@/e.json: /model/k_r: \"ten\" is not allowed; allowed: a number greater than 0 (radial stiffness, "
       "dimensionless)"},
      {with(R"("model": {"k_r": 1e999})"), "@/e.json: not JSON: number overflow parsing '1e999'"},
      {with(R"("model": {"A": 0.9})"),
       "@/e.json: /model/A: 0.9 is not allowed; allowed: a number at least 1 (maximum of chi, Eq. (7))"},
      {with(R"("model": {"lambda": 0})"),
       "@/e.json: /model/lambda: 0 is not allowed; allowed: a number greater than 0 (range of the pole "
       "repulsion, in units of r0)"},
      {with(R"("model": {"C": "peak"})"),
       "@/e.json: /model/C: \"peak\" is not allowed; allowed: a number at least -1000 and at most 1 or "
       "\"peak_at_V_s\" (shape "
       "of chi, "
       "Eq. (7))"},
      {with(R"("model": {"friction": "columb"})"),
       "@/e.json: /model/friction: \"columb\" is not allowed (did you mean coulomb?); allowed: " +
           quoted_laws() + " (local friction law)"},
      {with(R"("model": {"friction": null})"),
       "@/e.json: /model/friction: is missing; allowed: " + quoted_laws() + " (local friction law)"},
      {with(R"("load": {"z_0": 0.5})"),
       "@/e.json: /load: more than one of R_n, z_0 and trace is given: /load/R_n, /load/z_0; keep one (a "
       "null removes an "
       "inherited key)"},
      {with(R"("load": {"R_n": null})"),
       "@/e.json: /load: none of R_n, z_0 and trace is given, here or in the sweep"},
      {with(R"("load": {"R_n": null, "z_0": 0.99})"),
       "@/e.json: /load/z_0: 0.99 is above first contact; allowed: at most sin(phi_0) = 0.984808"},
      {with(R"("sweep": {"k_r": {"values": []}})"),
       "@/e.json: /sweep/k_r/values: [] is not allowed; allowed: an array, each a number or a string "
       "(ascending numbers, or the words of a choice)"},
      {with(R"("sweep": {"k_r": {"values": [2, 1]}})"),
       "@/e.json: /sweep/k_r: the values must ascend, but 1 follows 2"},
      {with(R"("sweep": {"k_r": {}})"),
       "@/e.json: /sweep/k_r: an axis needs exactly one of values, linspace, logspace; found none"},
      {with(R"("sweep": {"k_r": {"logspace": [0, 10, 5]}})"),
       "@/e.json: /sweep/k_r/logspace: a logarithmic axis cannot start at 0; allowed: greater than 0"},
      {with(R"("sweep": {"k_r": {"linspace": [1, 10, 2.5]}})"),
       "@/e.json: /sweep/k_r/linspace: the count 2.5 is not a positive integer"},
      {with(R"("sweep": {"A": {"linspace": [0.5, 1.5, 3]}})"),
       "@/e.json: /sweep/A: 0.5 is out of range for A; allowed: a number at least 1 (maximum of chi, Eq. "
       "(7))"},
      {with(R"("sweep": {"kr": {"values": [1]}})"),
       "@/e.json: /sweep/kr: kr cannot be swept (did you mean k_r?); allowed: k_r, k_theta, k_phi, "
       "phi_0_deg, zeta_theta, zeta_phi, mu_c, tau_f, R_c, E_star, A, C, V_s, lambda, lambda_z, alpha, beta, "
       "s_min, "
       "L_x, L_y, spacing, R, strain_limit, stretch_limit, R_n, nominal_friction, z_0, mean_deg, "
       "concentration, seed, rows, m_kg, r0_m, "
       "V0_m_per_s, E_Pa, nu, "
       "R_m, "
       "k_r_over_k_phi, k_theta_over_k_phi, k_r_N_per_m, k_theta_N_m, k_phi_N_m, E_star_Pa, tau_f_Pa, R_c_m, "
       "V_s_m_per_s, "
       "alpha_J, "
       "beta_J, R_n_N, z_0_m, L_x_m, L_y_m, spacing_m, friction, bending, initial_state, pole_rule, path, "
       "sampling"},
      {with(R"("sweep": {"friction": {"values": ["nss", "coulom"]}})"),
       "@/e.json: /sweep/friction/values: \"coulom\" is not known (did you mean coulomb?); allowed: " +
           laws()},
      {with(R"("sweep": {"friction": {"values": ["nss", "nss"]}})"),
       "@/e.json: /sweep/friction/values: \"nss\" appears twice"},
      {with(R"("sweep": {"friction": {"linspace": [0, 1, 2]}})"),
       "@/e.json: /sweep/friction: friction needs \"values\" alone, a list of words; allowed: " + laws()},
      {with(R"("sweep": {"k_r": {"values": ["soft"]}})"),
       "@/e.json: /sweep/k_r/values: \"soft\" is not a number"},
      {with(R"("sweep": {"R_n": {"values": [0, 1]}})"),
       "@/e.json: /sweep/R_n: 0 is out of range for R_n; allowed: a number greater than 0 (normal load "
       "R_n/N_c0, dimensionless)"},
      {with(R"("orientation": {"seed": 1})"),
       "@/e.json: /orientation/seed: is allowed with \"sampling\": \"lattice\" only"},
      {with(R"("orientation": {"sampling": "lattice"})"),
       "@/e.json: /orientation/rows: is missing; a lattice needs the number of rows that enter"},
      {with(R"("orientation": {"sampling": "lattice", "rows": 50})"),
       "@/e.json: /orientation/rows: the 50 rows have entered by t_2 = 10, but averaging begins at t_1 = 10 "
       "[2 L_x]; use more rows"},
      {with(R"("orientation": {"sampling": "lattice", "rows": 100}, "model": {"L_y": 5.1})"),
       "@/e.json: /model/L_y: 5.1 is 25.5 times the spacing 0.2; a lattice needs a whole number"},
      {with(R"("orientation": {"sampling": "lattice", "rows": 100}, "load": {"R_n": null, "trace": {}})"),
       "@/e.json: /load/trace: cannot be combined with \"sampling\": \"lattice\"; use quadrature or list"},
      {with(R"("record": ["slab_force"])"), "@/e.json: /record: slab_force needs \"sampling\": \"lattice\""},
      {with(R"("record": ["trajectories"])"),
       "@/e.json: /trajectories: is missing; recording trajectories needs {\"theta_0_deg\": [...]}"},
      {with(R"("record": ["bristles"], "load": {"R_n": null, "trace": {}})"),
       "@/e.json: /record: a trace of R_n(z_0) records observables only"},
      {with(R"("sweep": {"k_r": {"linspace": [1, 2, 1e12]}})"),
       "@/e.json: /sweep/k_r/linspace: 1000000000000 points; allowed: at most 1e+07 in the sweep"},
      {with(R"("sweep": {"k_r": {"linspace": [1, 2, 1e6]}, "k_phi": {"linspace": [1, 2, 1e6]}})"),
       "@/e.json: /sweep: 1e+12 points or more; allowed: at most 1e+07"},
      {with(R"("sweep": {"k_r": {"values": [1, 2], "take": [2]}})"),
       "@/e.json: /sweep/k_r/take: 2 is not allowed; allowed: ascending indices from 0 to 1"},
      {with(R"("sweep": {"sample": {"table": {"columns": ["k_r"], "rows": [[1], [2]]}}},
            "tiers": {"smoke": {"sweep": {"k_r": {"values": [1]}}}})"),
       "@/e.json: /sweep/sample: k_r is varied by another axis, too; remove one of them (tier smoke)"},
      {with(R"("tiers": {"smoke": {"model": {"k_r": -1}}})"),
       "@/e.json (tier smoke): /model/k_r: -1 is not allowed; allowed: a number greater than 0 (radial "
       "stiffness, "
       "dimensionless)"},
      {with(R"("orientation": {"sampling": "list"})"),
       "@/e.json: /orientation/theta_0_deg: is missing; sampling by list needs the azimuths in degrees"},
      {with(R"("orientation": {"distribution": "von_mises"})"),
       "@/e.json: /orientation/concentration: is missing; a von Mises distribution needs concentration and "
       "mean_deg"},
      {with(R"("checks": [{"claim": "1"}])"),
       "@/e.json: /checks/0/statement: is missing; allowed: a string (statement of the paper and the "
       "measured number that decides it)"},
      {with(R"("sweep": {"V0_m_per_s": {"values": [1, 2]}})"),
       "@/e.json: /si/V0_m_per_s: is swept, but there is no si block with m_kg, r0_m and V0_m_per_s"},
      {with(
           R"("si": {"m_kg": 1, "r0_m": 1, "V0_m_per_s": 1, "k_r_N_per_m": 1}, "sweep": {"k_r": {"values": [1, 2]}})"),
       "@/e.json: /si/k_r_N_per_m: k_r, which it replaces, is swept as well; remove one of them"},
      {with(R"("si": {"m_kg": 1, "r0_m": 1, "V0_m_per_s": 1, "nu": 0.4})"),
       "@/e.json: /si/E_Pa: is missing; nu and R_m need it"},
      {with(
           R"("si": {"m_kg": 1, "r0_m": 1, "V0_m_per_s": 1, "E_Pa": 1e8, "R_m": 0.001, "k_r_over_k_phi": 10})"),
       "@/e.json: /si/nu: E_Pa needs either nu or E_star_Pa for the contact modulus; neither is "
       "given"},
      {with(R"("model": {"A": 1})"),
       "@/e.json: /model/A: 1 has no maximum of chi at V_s; allowed: at least 1.001, or a number for C (0: "
       "chi rises to 1)"},
      {with(R"("orientation": {"distribution": "von_mises", "mean_deg": 1e300, "sampling": "quadrature"})"),
       "@/e.json: /orientation/mean_deg: 1e+300 is not allowed; allowed: a number at least -360 and at "
       "most 360 (von Mises: mean of theta_0, degrees)"},
      {with(
           R"("orientation": {"distribution": "von_mises", "concentration": 1e9, "sampling": "quadrature"})"),
       "@/e.json: /orientation/concentration: 1000000000.0 is not allowed; allowed: a number at least 0 and "
       "at most 100000000.0 (von Mises: concentration kappa)"},
      {with(R"("si": {"m_kg": 1, "r0_m": 1, "V0_m_per_s": 1, "E_Pa": 1e8, "R_m": 0.001})"),
       "@/e.json: /si/k_r_over_k_phi: R_m needs either k_r_over_k_phi or k_r_N_per_m for the radial "
       "stiffness; neither is given"},
      {with(
           R"("si": {"m_kg": 1, "r0_m": 1, "V0_m_per_s": 1, "E_Pa": 1e8, "nu": 0.4, "R_m": 1, "k_r_over_k_phi": 1, "k_r_N_per_m": 1})"),
       "@/e.json: /si/k_r_over_k_phi: R_m needs either k_r_over_k_phi or k_r_N_per_m for the radial "
       "stiffness; both are given"},
      {with(
           R"("si": {"m_kg": 1, "r0_m": 1, "V0_m_per_s": 1, "R_n_N": 1}, "load": {"R_n": null, "z_0": 0.9})"),
       "@/e.json: /load: more than one of R_n, z_0 and trace is given: /load/z_0, /si/R_n_N; keep one (a "
       "null "
       "removes an inherited key)"},
      {with(
           R"("si": {"m_kg": 1, "r0_m": 2, "V0_m_per_s": 1, "R_n_N": 1, "z_0_m": 0.5}, "load": {"R_n": null})"),
       "@/e.json: /load: more than one of R_n, z_0 and trace is given: /si/R_n_N, /si/z_0_m; keep one (a "
       "null "
       "removes an inherited key)"},
      {with(R"("si": {"m_kg": 1, "r0_m": 2, "V0_m_per_s": 1, "z_0_m": 1.99}, "load": {"R_n": null})"),
       "@/e.json: /si/z_0_m: 1.99 m is above first contact; allowed: at most r_0 sin(phi_0) = 1.96962 m"},
      {with(R"("load": {"R_n": null, "z_0": 0.9, "nominal_friction": 2})"),
       "@/e.json: /load/nominal_friction: needs a target load R_n, which it multiplies"},
      {with(R"("sweep": {"nominal_friction": {"values": [1]}, "tau_f": {"values": [1]}})"),
       "@/e.json: /sweep/nominal_friction: and tau_f both give the strength of friction; remove one of them"},
      {R"({"extends": "nowhere.json"})",
       "@/e.json: /extends: \"nowhere.json\" does not exist (looked for @/nowhere.json)"},
      {R"({"extends": "e.json"})",
       "@/e.json: /extends: \"e.json\" extends this file in turn; remove one of the two"},
      {R"({"extends": 3})", "@/e.json: /extends: 3 is not a file name"},
  };
  for (const Row& row : table) {
    CAPTURE(row.text);
    CHECK(error_of(row.text) == row.message);
  }
}

TEST_CASE("an experiment with excessive nesting is an error, not a crash") {
  const Scratch s;
  for (const char* bracket : {"[", "{\"a\":"}) {
    std::string text;
    for (int i = 0; i < 100000; ++i) text += bracket;
    CHECK_THROWS_WITH(load_experiment(s.write("e.json", text), {}),
                      Catch::Contains("e.json: JSON nested more than 64 levels deep"));
  }
}

TEST_CASE("extends: chains, subfolders, and files outside the experiments folder") {
  Scratch s;
  s.write("experiments/paper.json", bytes_of(kExperiments + "/paper.json"));
  const auto child =
      s.write("experiments/more/a.json", R"({"extends": "../paper.json", "model": {"k_r": 7}})");
  CHECK(load_experiment(child, {}).base.setup.parameters.k_r == 7);
  const auto grandchild =
      s.write("experiments/more/b.json", R"({"extends": "a.json", "model": {"k_phi": 3}})");
  const Experiment e = load_experiment(grandchild, {});
  CHECK(e.base.setup.parameters.k_r == 7);
  CHECK(e.base.setup.parameters.k_phi == 3);
  s.write("outside.json", "{}");
  const auto outside = s.write("experiments/c.json", R"({"extends": "../outside.json"})");
  CHECK_THROWS_WITH(load_experiment(outside, {}), Catch::Contains("lies outside the experiments folder"));
  s.write("experiments/d.json", R"({"extends": "e.json"})");
  const auto circle = s.write("experiments/e.json", R"({"extends": "d.json"})");
  CHECK_THROWS_WITH(load_experiment(circle, {}), Catch::Contains("extends this file in turn"));
  CHECK_THROWS_WITH(load_experiment(s.path("nothing.json"), {}),
                    Catch::EndsWith("cannot be read: no such file"));
}

TEST_CASE("the option --set changes a value, is named in errors, and refuses invalid arguments") {
  const std::string file = kExperiments + "/paper.json";
  CHECK(load_experiment(file, {{"/model/k_r=33"}, "full"}).base.setup.parameters.k_r == 33);
  CHECK(load_experiment(file, {{"/model/friction=coulomb"}, "full"}).base.setup.parameters.friction ==
        FrictionLaw::coulomb);
  const Experiment swept = load_experiment(file, {{R"(/sweep/k_r={"values":[1,2]})"}, "full"});
  CHECK(swept.points() == 2);
  CHECK(error_of(with(R"("title": "x")"), {{"/model/k_r=-1"}, "full"}) ==
        "--set /model/k_r=-1: /model/k_r: -1 is not allowed; allowed: a number greater than 0 (radial "
        "stiffness, "
        "dimensionless)");
  CHECK_THROWS_WITH(load_experiment(file, {{"/model/k_r"}, "full"}), Catch::Contains("'=' is missing"));
  CHECK_THROWS_WITH(load_experiment(file, {{"model/k_r=1"}, "full"}),
                    Catch::Contains("must be empty or begin with '/'"));
  CHECK_THROWS_WITH(load_experiment(file, {{"/model/k_r=1x"}, "full"}), Catch::Contains("not JSON"));
  CHECK_THROWS_WITH(load_experiment(file, {{"/name=\xff"}, "full"}), Catch::Contains("invalid UTF-8"));
  std::string deep;
  for (int i = 0; i < 30000; ++i) deep += "/a";
  CHECK_THROWS_WITH(load_experiment(file, {{deep + "=1"}, "full"}),
                    Catch::Contains("more than 64 levels deep"));
}

TEST_CASE("the option --set changes elements of arrays, and refuses pointers to nothing") {
  const auto changed = [](std::vector<std::string> changes) {
    changes.insert(changes.begin(), {R"(/load={"R_n":null,"path":null,"z_0":0.5})",
                                     R"(/orientation={"sampling":"list","theta_0_deg":[10,100,170]})"});
    std::vector<double> degrees;
    for (const double theta_0 :
         load_experiment(kExperiments + "/paper.json", {changes, "full"}).base.setup.orientation.theta_0)
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
  REQUIRE(full.axes.size() == 3);
  CHECK(full.axes[0].name == "bending");
  CHECK(full.points() == 2400);
  const std::vector<double>& k_r = full.axes[1].values;
  CHECK(k_r.front() == 5);
  CHECK(k_r.back() == 100);
  for (std::size_t i = 1; i < 40; ++i) CHECK(k_r[i] / k_r[i - 1] == Approx(std::pow(100.0 / 5, 1.0 / 39)));
  for (std::size_t d = 0; d < 3; ++d)
    for (const double value : smoke.axes[d].values)
      CHECK(std::count(full.axes[d].values.begin(), full.axes[d].values.end(), value) == 1);
}

TEST_CASE("points are in row-major order over the axes, and C follows A if chi is to peak at V_s") {
  const Experiment e =
      load_experiment(kExperiments + "/paper.json",
                      {{R"(/sweep/A={"values":[1.2,1.5]})", R"(/sweep/R_n={"values":[1,2,3]})"}, "full"});
  CHECK(e.points() == 6);
  const PointInput p = e.point(4);
  CHECK(p.setup.parameters.A == 1.5);
  CHECK(p.loading.R_n == 2);
  CHECK(p.setup.parameters.C == Approx(chi_C_peak_at_V_s(1.5)));
  CHECK(e.point(0).setup.parameters.C == Approx(chi_C_peak_at_V_s(1.2)));
}

TEST_CASE("the nominal friction is the friction of rigid bristles over their load, under every law") {
  const Scratch s;
  s.write("paper.json", bytes_of(kExperiments + "/paper.json"));
  const std::string sweep = R"("nominal_friction": {"values": [0.5, 6.1984]}, "R_n": {"values": [0.3, 2]})";
  const Experiment e = load_experiment(
      s.write("e.json", R"({"extends": "paper.json", "name": "e", "friction_law": {"V_R": [0, 1, 2], "mu": [0, 0.3, 0.2], "between": "linear"},
          "sweep": {"friction": {"values": )" +
                            Json(texts(words<FrictionLaw>())).dump() + "}, " + sweep + "}}"),
      {});
  for (std::size_t i = 0; i < e.points(); ++i) {
    const PointInput point = e.point(i);
    const double nominal = rigid_friction(point.setup.parameters, point.loading.R_n) / point.loading.R_n;
    CHECK(nominal == Approx(*point.nominal_friction).epsilon(1e-14));
  }
  CHECK(e.point(3).setup.parameters.tau_f == Approx(3e4).epsilon(1e-5));  // the paper's, at R_n = 2
  CHECK(e.point(7).setup.parameters.mu_c == 6.1984);
}

TEST_CASE("an SI block gives the dimensionless values of the paper") {
  const Experiment e = load_experiment(
      kExperiments + "/paper.json",
      {{R"(/si={"m_kg":1e-4,"r0_m":0.017,"V0_m_per_s":10,"R_c_m":0.001,"E_star_Pa":1.190476e8,"k_theta_N_m":0.01,
           "k_r_N_per_m":346.0207612})"},
       "full"});
  const Parameters& p = e.base.setup.parameters;
  CHECK(p.R_c == Approx(1.0 / 17));
  CHECK(p.E_star == Approx(5.849e4).epsilon(1e-3));
  CHECK(p.k_theta == Approx(1));
  CHECK(p.k_r == Approx(10));
}

TEST_CASE("a material in SI units has the same stiffness at every velocity") {
  const Experiment e = load_experiment(kExperiments + "/ski.json", {});
  // V0_m_per_s is the last axis: 13 values from 2 to 32.
  const PointInput slow = e.point(0), fast = e.point(12);
  const Parameters &a = slow.setup.parameters, &b = fast.setup.parameters;
  CHECK(slow.si.at("V0_m_per_s") == 2);
  CHECK(fast.si.at("V0_m_per_s") == 32);
  // 3 pi E R^4/(4 r0), computed here independently
  const double k = 3 * M_PI * 1e8 * std::pow(0.00108, 4) / (4 * 0.017);
  CHECK(a.k_phi * 1e-4 * 4 == Approx(k));
  CHECK(b.k_phi * 1e-4 * 1024 == Approx(k));
  CHECK(a.k_theta == a.k_phi);
  CHECK(a.bending == Bending::rod);
  CHECK(a.k_r == Approx(10 * a.k_phi));
  for (const auto member : {&Parameters::k_r, &Parameters::E_star, &Parameters::tau_f, &Parameters::beta})
    CHECK(a.*member / (b.*member) == Approx(256));
  CHECK(a.V_s / b.V_s == Approx(16));
  CHECK(a.E_star * 1e-4 * 4 / std::pow(0.017, 3) == Approx(1e8 / (1 - 0.16)));
  CHECK(slow.loading.R_n * si_scales(slow).force == Approx(0.1));
  CHECK(fast.loading.R_n * si_scales(fast).force == Approx(0.1));
}

TEST_CASE("a measured polar stiffness replaces that of the shaft, and the ratios are to it") {
  const Experiment e = load_experiment(kExperiments + "/ski.json", {{"/si/k_phi_N_m=0.02"}, "full"});
  const PointInput point = e.point(0);
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
    const PointInput point = e.point(i);
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
  const auto set = warnings(R"({"extends": "ski.json", "name": "e"})", {"/model/tau_f=1"});
  REQUIRE(set.size() == 1);
  CHECK_THAT(set[0], Catch::StartsWith("--set /model/tau_f=1: /model/tau_f: has no effect"));
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

TEST_CASE("a tier removes keys by null, and an extending experiment can remove the tier of its parent") {
  Scratch s;
  s.write("experiments/paper.json", bytes_of(kExperiments + "/paper.json"));
  const auto parent = s.write("experiments/a.json", R"({"extends": "paper.json", "name": "a",
    "tiers": {"smoke": {"load": {"R_n": null, "path": null, "z_0": 0.5}}}})");
  CHECK(load_experiment(parent, {{}, "smoke"}).base.loading.z_0 == 0.5);
  CHECK_FALSE(load_experiment(parent, {}).base.loading.z_0);
  const auto child = s.write("experiments/b.json", R"({"extends": "a.json", "tiers": {"smoke": null}})");
  CHECK_FALSE(load_experiment(child, {{}, "smoke"}).base.loading.z_0);
}

TEST_CASE("a change by --set concerns the chosen tier, also where another tier lacks the key") {
  Scratch s;
  s.write("experiments/paper.json", bytes_of(kExperiments + "/paper.json"));
  const auto file = s.write("experiments/a.json", R"({"extends": "paper.json", "name": "a", "load": {"path": "loading"},
    "sweep": {"k_r": {"values": [5, 10]}}, "locate_jumps": "k_r", "tiers": {"study": {"locate_jumps": null}}})");
  CHECK(load_experiment(file, {}).locate_jumps == "k_r");
  CHECK(load_experiment(file, {{"/locate_jumps=null"}, "full"}).locate_jumps.empty());
}

}  // namespace bristle::experiment_test
