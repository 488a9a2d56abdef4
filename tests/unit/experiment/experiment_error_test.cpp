#include "experiment/experiment.hpp"
#include "bristle/model/friction/laws.hpp"
#include "util/error.hpp"
#include "scratch.hpp"

#include "catch.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <filesystem>

namespace bristle::experiment_error_test {
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
       "institution, model, si, friction_law, load, orientation, scatter, integrator, sweep, locate_jumps, "
       "analysis, "
       "design, record, "
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
       "@/e.json: /locate_jumps: needs a load R_n: at a given gap, no gap jumps"},
      {with(R"("model": {"k_tehta": 1})"),
       "@/e.json: /model/k_tehta: unknown key (did you mean k_theta?); allowed: friction, bending, contact, "
       "section, "
       "initial_state, pole_rule, k_r, k_theta, k_phi, phi_0_deg, zeta_theta, zeta_phi, mu_c, tau_f, R_c, "
       "E_star, "
       "A, C, V_s, lambda, lambda_z, alpha, beta, s_min, L_x, L_y, spacing, R, "
       "strain_limit, stretch_limit, pressure_limit"},
      {with(R"("model": {"k_r": "ten"})"),
       "@/e.json: /model/k_r: \"ten\" is not allowed; allowed: a number greater than 0 (radial stiffness, "
       "dimensionless)"},
      {with(R"("model": {"k_r": 1e999})"), "@/e.json: 1e999 is beyond the largest number, 1.8e308"},
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
       "@/e.json: /load: R_n and z_0 are both given: /load/R_n, /load/z_0; keep one (a null removes an "
       "inherited key)"},
      {with(R"("load": {"R_n": null})"),
       "@/e.json: /load: neither R_n nor z_0 is given, here or in the sweep"},
      {with(R"("load": {"R_n": null}, "si": {"m_kg": 1e-4, "r0_m": 0.017, "V0_m_per_s": 10})"),
       "@/e.json: /si: the load is missing: none of R_n_N, pressure_Pa and z_0_m is given, here or in the "
       "sweep"},
      {with(R"("load": {"R_n": null, "z_0": 1.085})"),
       "@/e.json: /load/z_0: 1.085 is above first contact, beyond the wall; allowed: at most sin(phi_0) + "
       "100 lambda_z = "
       "1.084808"},
      {with(R"("sweep": {"lambda_z": {"values": [0.0005, 0.001]}}, "load": {"R_n": null, "z_0": 1.08})"),
       "@/e.json: /load/z_0: 1.08 is above first contact at lambda_z = 0.0005, beyond the wall; allowed: at "
       "most "
       "sin(phi_0) + 100 lambda_z = 1.034808"},
      {with(R"("sweep": {"k_r": {"values": []}})"),
       "@/e.json: /sweep/k_r/values: [] is not allowed; allowed: an array of at least 1, each a number or a "
       "string "
       "(ascending numbers, or the words of a choice)"},
      {with(R"("sweep": {"k_r": {"values": [2, 1]}})"),
       "@/e.json: /sweep/k_r: the values must ascend, but 1 follows 2"},
      {with(R"("sweep": {"k_r": {}})"),
       "@/e.json: /sweep/k_r: an axis needs exactly one of values, linspace, logspace; found none"},
      {with(R"("sweep": {"k_r": {"logspace": [0, 10, 5]}})"),
       "@/e.json: /sweep/k_r/logspace/0: a logarithmic axis cannot start at 0; allowed: greater than 0"},
      {with(R"("sweep": {"k_r": {"logspace": [1, -10, 5]}})"),
       "@/e.json: /sweep/k_r/logspace/1: a range must end above its start, 1, but -10 does not"},
      {with(R"("sweep": {"k_r": {"linspace": [10, 10, 5]}})"),
       "@/e.json: /sweep/k_r/linspace/1: a range must end above its start, 10, but 10 does not"},
      {with(R"("sweep": {"k_r": {"linspace": [1, 10, 2.5]}})"),
       "@/e.json: /sweep/k_r/linspace/2: the count 2.5 is not a positive integer"},
      {with(R"("sweep": {"A": {"linspace": [0.5, 1.5, 3]}})"),
       "@/e.json: /sweep/A: 0.5 is out of range for A; allowed: a number at least 1 (maximum of chi, Eq. "
       "(7))"},
      {with(R"("sweep": {"kr": {"values": [1]}})"),
       "@/e.json: /sweep/kr: kr cannot be swept (did you mean k_r?); allowed: k_r, k_theta, k_phi, "
       "phi_0_deg, zeta_theta, zeta_phi, mu_c, tau_f, R_c, E_star, A, C, V_s, lambda, lambda_z, alpha, beta, "
       "s_min, "
       "L_x, L_y, spacing, R, strain_limit, stretch_limit, pressure_limit, R_n, nominal_friction, z_0, "
       "mean_deg, "
       "concentration, seed, rows, scatter_r0, scatter_R, scatter_E, scatter_phi_0_deg, m_kg, rho_kg_per_m3, "
       "r0_m, "
       "V0_m_per_s, E_Pa, nu, "
       "R_m, "
       "k_r_over_k_phi, k_theta_over_k_phi, k_r_N_per_m, k_theta_N_m, k_phi_N_m, E_star_Pa, "
       "pressure_limit_Pa, tau_f_Pa, R_c_m, "
       "V_s_m_per_s, "
       "alpha_J, "
       "beta_J, R_n_N, pressure_Pa, z_0_m, L_x_m, L_y_m, spacing_m, friction, bending, contact, section, "
       "initial_state, "
       "pole_rule, "
       "path, "
       "sampling"},
      {with(R"("scatter": {"r0": {"normal": 0.2}})"),
       "@/e.json: /scatter/r0: 0.2 is too wide: the length of the bristles could reach zero; allowed: less "
       "than 0.2"},
      {with(R"("scatter": {"phi_0_deg": {"uniform": 0.13}})"),
       "@/e.json: /scatter/phi_0_deg: 0.13 is too wide: the undeformed polar angle could reach 90 degrees; "
       "allowed: less than 0.125"},
      {with(R"("scatter": {"R": {"uniform": 0.5}}, "sweep": {"scatter_E": {"values": [0.1, 0.25]}})"),
       "@/e.json: /sweep/scatter_E: 0.25 is too wide: the Young's modulus could reach zero; allowed: less "
       "than 0.2"},
      {with(R"("scatter": {"R": {"uniform": 0.5}}, "record": ["bristles"])"),
       "@/e.json: /record: bristles of a brush with scatter are in units of their own; remove \"bristles\""},
      {with(R"("scatter": {"r_0": {"normal": 0.1}})"),
       "@/e.json: /scatter/r_0: unknown key (did you mean r0?); allowed: bristles, r0, R, E, phi_0_deg"},
      {with(R"("scatter": {"scatter_r0": 0.1})"),
       "@/e.json: /scatter/scatter_r0: unknown key (did you mean /scatter/r0/normal or "
       "/scatter/r0/uniform?); allowed: bristles, r0, R, E, phi_0_deg"},
      {with(R"("scatter": {"r0": {"normal": 0.1, "uniform": 0.1}})"),
       "@/e.json: /scatter/r0: {\"normal\":0.1,\"uniform\":0.1} is not allowed; allowed: an object that is "
       "not "
       "empty (one of normal, uniform)"},
      {with(R"("scatter": {"bristles": 20})"),
       "@/e.json: /scatter/bristles: 20 is not allowed; allowed: 16, 32, 64, 128, 256, 512 (different "
       "bristles that stand for the brush)"},
      {with(R"("model": {"contact": "hertz", "lambda_z": 0.002})"),
       "@/e.json: /model/lambda_z: has no meaning for the contact \"hertz\", which E_star and R_c determine; "
       "remove it, or set /model/contact to \"wall\""},
      {with(R"("si": {"m_kg": 1e-4, "r0_m": 0.017, "V0_m_per_s": 10, "beta_J": 0.01})"),
       "@/e.json: /si/beta_J: has no meaning for the contact \"hertz\", which E_star and R_c determine; "
       "remove it, "
       "or set /model/contact to \"wall\""},
      {with(R"("model": {"contact": "hertz"}, "load": {"R_n": null, "z_0": 0.99})"),
       "@/e.json: /load/z_0: 0.99 is above first contact; allowed: at most sin(phi_0) = 0.984808"},
      {with(R"("model": {"bending": "rod", "k_theta": 1})"),
       "@/e.json: /model/k_theta: has no effect on round rods, whose k_theta is k_phi; remove it, or set "
       "/model/section to \"oval\""},
      {with(R"("sweep": {"bending": {"values": ["polar", "rod"]}, "k_theta": {"values": [1, 2]}})"),
       "@/e.json: /sweep/k_theta: has no effect on round rods, whose k_theta is k_phi; remove it, or set "
       "/model/section to \"oval\""},
      {with(
           R"("model": {"bending": "rod"}, "sweep": {"sample": {"table": {"columns": ["k_theta"], "rows": [[1]]}}})"),
       "@/e.json: /sweep/sample/table: k_theta has no effect on round rods, whose k_theta is k_phi; remove "
       "it, or set "
       "/model/section to \"oval\""},
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
      {with(R"("record": ["slab_force"])"), "@/e.json: /record: slab_force needs \"sampling\": \"lattice\""},
      {with(R"("record": ["trajectories"])"),
       "@/e.json: /trajectories: is missing; recording trajectories needs {\"theta_0_deg\": [...]}"},
      {with(R"("sweep": {"k_r": {"linspace": [1, 2, 1e12]}})"),
       "@/e.json: /sweep/k_r/linspace/2: 1000000000000 points; allowed: at most 1e+07 in the sweep"},
      {with(R"("sweep": {"k_r": {"linspace": [1, 2, 1e6]}, "k_phi": {"linspace": [1, 2, 1e6]}})"),
       "@/e.json: /sweep: 1e+12 points or more; allowed: at most 1e+07"},
      {with(R"("sweep": {"k_r": {"values": [1, 2], "take": [2]}})"),
       "@/e.json: /sweep/k_r/take: 2 is not allowed; allowed: ascending indices from 0 to 1"},
      {with(R"("orientation": {"sampling": "list"})"),
       "@/e.json: /orientation/theta_0_deg: is missing; sampling by list needs the azimuths in degrees"},
      {with(R"("orientation": {"distribution": "von_mises"})"),
       "@/e.json: /orientation/concentration: is missing; a von Mises distribution needs concentration and "
       "mean_deg"},
      {with(R"("checks": [{"claim": "1"}])"),
       "@/e.json: /checks/0/statement: is missing; allowed: a string (statement of the paper and the "
       "measured number that decides it)"},
      {with(R"("sweep": {"V0_m_per_s": {"values": [1, 2]}})"),
       "@/e.json: /si/V0_m_per_s: is swept, but there is no si block with r0_m, V0_m_per_s, and m_kg or "
       "rho_kg_per_m3"},
      {with(
           R"("si": {"m_kg": 1, "r0_m": 1, "V0_m_per_s": 1, "k_r_N_per_m": 1}, "sweep": {"k_r": {"values": [1, 2]}})"),
       "@/e.json: /si/k_r_N_per_m: k_r, which it replaces, is swept as well; remove one of them"},
      {with(R"("si": {"r0_m": 1, "V0_m_per_s": 1})"),
       "@/e.json: /si/m_kg: is missing; give it, or rho_kg_per_m3 and R_m, from which it follows"},
      {with(R"("si": {"m_kg": 1, "rho_kg_per_m3": 1000, "r0_m": 1, "V0_m_per_s": 1})"),
       "@/e.json: /si/rho_kg_per_m3: is given, and so is m_kg; both are the mass of a bristle: remove one of "
       "them "
       "(a null removes an inherited key)"},
      {with(R"("si": {"rho_kg_per_m3": 1000, "r0_m": 1, "V0_m_per_s": 1})"),
       "@/e.json: /si/R_m: is missing; the mass of a bristle follows from it and rho_kg_per_m3"},
      {with(
           R"("si": {"m_kg": 1, "r0_m": 1, "V0_m_per_s": 1, "R_n_N": 1, "pressure_Pa": 1}, "load": {"R_n": null})"),
       "@/e.json: /si/pressure_Pa: is given, and so is R_n_N; both are the load: remove one of them (a null "
       "removes an inherited key)"},
      {with(
           R"("si": {"m_kg": 1, "r0_m": 1, "V0_m_per_s": 1, "pressure_Pa": 1}, "load": {"R_n": null, "z_0": 0.9})"),
       "@/e.json: /load: R_n and z_0 are both given: /load/z_0, /si/pressure_Pa; keep one "
       "(a "
       "null removes an inherited key)"},
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
       "@/e.json: /load: R_n and z_0 are both given: /load/z_0, /si/R_n_N; keep one (a "
       "null "
       "removes an inherited key)"},
      {with(
           R"("si": {"m_kg": 1, "r0_m": 2, "V0_m_per_s": 1, "R_n_N": 1, "z_0_m": 0.5}, "load": {"R_n": null})"),
       "@/e.json: /load: R_n and z_0 are both given: /si/R_n_N, /si/z_0_m; keep one (a "
       "null "
       "removes an inherited key)"},
      {with(R"("si": {"m_kg": 1, "r0_m": 2, "V0_m_per_s": 1, "z_0_m": 2.2}, "load": {"R_n": null})"),
       "@/e.json: /si/z_0_m: 2.2 m is above first contact; allowed: at most r_0 sin(phi_0) = 1.96962 m"},
      {with(
           R"("model": {"contact": "wall"}, "si": {"m_kg": 1, "r0_m": 2, "V0_m_per_s": 1, "z_0_m": 2.2}, "load": {"R_n": null})"),
       "@/e.json: /si/z_0_m: 2.2 m is above first contact, beyond the wall; allowed: at most r_0 (sin(phi_0) "
       "+ 100 "
       "lambda_z) = 2.16962 m"},
      {with(R"("load": {"R_n": null, "z_0": 0.9, "nominal_friction": 2})"),
       "@/e.json: /load/nominal_friction: needs a target load R_n, which it multiplies"},
      {with(R"("sweep": {"nominal_friction": {"values": [1]}, "tau_f": {"values": [1]}})"),
       "@/e.json: /sweep/nominal_friction: is given, and so is tau_f; both are the strength of friction: "
       "remove one "
       "of them"},
      {with(R"("integrator": {"max_evaluations_per_point": 2e7})"),
       "@/e.json: /integrator/max_evaluations_per_point: 20000000.0 is not allowed; write 20000000; allowed: "
       "an integer "
       "at least 1000 and at most 1000000000000000 (maximum number of evaluations of the equations per sweep "
       "point by "
       "quadrature)"},
      {with(R"("record": ["observables", "observables"])"),
       "@/e.json: /record: [\"observables\",\"observables\"] is not allowed: \"observables\" appears twice; "
       "allowed: an "
       "array, each \"observables\", \"bristles\", \"trajectories\", \"slab_force\" (data to record in the "
       "result file)"},
      {with(R"("sweep": {"k_r": {"logspace": [1, 2]}})"),
       "@/e.json: /sweep/k_r/logspace: [1,2] is not allowed; allowed: an array of 3, each a number ([from, "
       "to, count])"},
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
  CHECK_THAT(error_of(with(R"("model": {"K_R": 1})")),
             Catch::Contains("/model/K_R: unknown key (did you mean k_r?)"));
  CHECK_THAT(error_of(with(R"("model": {"R_m": 1})")),
             Catch::Contains("/model/R_m: unknown key (did you mean /si/R_m?); allowed: friction"));
  CHECK_THAT(error_of(with(R"("sweep": {"Mu_C": {"values": [1, 2]}})")),
             Catch::Contains("did you mean mu_c?"));
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

TEST_CASE("the option --set changes a value, is named in errors, and refuses invalid arguments") {
  const std::string file = kExperiments + "/paper.json";
  CHECK(load_experiment(file, {{"/model/k_r=33"}, "full"}).sweep.base.setup.parameters.k_r == 33);
  CHECK(load_experiment(file, {{"/model/friction=coulomb"}, "full"}).sweep.base.setup.parameters.friction ==
        FrictionLaw::coulomb);
  const Experiment swept = load_experiment(file, {{R"(/sweep/k_r={"values":[1,2]})"}, "full"});
  CHECK(swept.sweep.size() == 2);
  CHECK(error_of(with(R"("title": "x")"), {{"/model/k_r=-1"}, "full"}) ==
        "--set /model/k_r=-1: /model/k_r: -1 is not allowed; allowed: a number greater than 0 (radial "
        "stiffness, "
        "dimensionless)");
  CHECK_THROWS_WITH(load_experiment(file, {{"/model/k_r"}, "full"}), Catch::Contains("'=' is missing"));
  CHECK_THROWS_WITH(load_experiment(file, {{"bristle/model/k_r=1"}, "full"}),
                    Catch::Contains("a place in an experiment begins with /"));
  CHECK_THROWS_WITH(load_experiment(file, {{"/model/k_r=1x"}, "full"}),
                    Catch::Contains("'1x' is neither a number"));
  CHECK_THROWS_WITH(load_experiment(file, {{"/name=\xff"}, "full"}), Catch::Contains("invalid UTF-8"));
  std::string deep;
  for (int i = 0; i < 30000; ++i) deep += "/a";
  CHECK_THROWS_WITH(load_experiment(file, {{deep + "=1"}, "full"}),
                    Catch::Contains("more than 64 levels deep"));
}

}  // namespace bristle::experiment_error_test
