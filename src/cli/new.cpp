#include "cli/commands.hpp"

#include "experiment/experiment.hpp"
#include "util/data.hpp"
#include "util/error.hpp"
#include "util/file.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace bristle::cli {

namespace {

// JSON has no comments: the notes, which become part of the result, explain the file.
constexpr const char* kStart = R"({
 "schema": "bristle-experiment/1",
 "extends": "paper.json",
 "name": "NAME",
 "title": "Friction over radial stiffness, for two friction laws",
 "notes": [
  "This file states what differs from paper.json, the paper's parameters, which comes with bristle. `bristle schema` describes all keys.",
  "model: parameters of bristle, friction and slab, dimensionless. load: R_n is the normal load over N_c0.",
  "orientation: rtol is the requested relative error of each mean over theta_0; the figures of the paper have 0.001.",
  "sweep: the axes of the result. An axis has values, or linspace or logspace with from, to and count."
 ],
 "model": {"k_theta": 1},
 "load": {"R_n": 2},
 "orientation": {"rtol": 0.02},
 "sweep": {"friction": {"values": ["nss", "coulomb"]}, "k_r": {"logspace": [3, 30, 5]}}
})";

// The material of the paper's section 3.
constexpr const char* kStartInSi = R"({
 "schema": "bristle-experiment/1",
 "extends": "paper.json",
 "name": "NAME",
 "title": "Friction of a brush over velocity",
 "notes": [
  "si: the material of the paper's section 3 in SI units, as round rods: bending is rod, and k_theta = k_phi. docs/own-material.md tells how to find each value; `bristle validate` prints the dimensionless ones.",
  "model: what has no unit, and the friction law, nss (nominal shear stress tau_f_Pa) or coulomb (mu_c).",
  "orientation: rtol is the requested relative error of each mean over theta_0; the figures of the paper have 0.001.",
  "sweep: the axes of the result. An axis has values, or linspace or logspace with from, to and count."
 ],
 "model": {"friction": "nss"},
 "si": {
  "m_kg": 1e-4,
  "r0_m": 0.017,
  "V0_m_per_s": 10,
  "E_Pa": 1e8,
  "nu": 0.4,
  "R_m": 0.00108,
  "k_r_over_k_phi": 10,
  "R_c_m": 0.001,
  "tau_f_Pa": 1e7,
  "V_s_m_per_s": 0.1,
  "beta_J": 0.01,
  "R_n_N": 0.6,
  "spacing_m": 0.0034,
  "L_x_m": 0.085
 },
 "orientation": {"rtol": 0.005},
 "sweep": {"V0_m_per_s": {"logspace": [3, 30, 7]}}
})";

}  // namespace

std::string new_experiment_path(const std::string& name) {
  return std::filesystem::is_directory("experiments") ? fmt::format("experiments/{}.json", name)
                                                      : name + ".json";
}

int new_command(const std::string& given, bool in_si) {
  const std::string name = given.ends_with(".json") ? given.substr(0, given.size() - 5) : given;
  if (name.empty() || name.find_first_not_of(
                          "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_.-") != name.npos)
    throw InputError(
        fmt::format("new: NAME {} is not allowed; allowed: letters, digits, _ . -", Json(given).dump()));
  const std::string path = new_experiment_path(name);
  if (std::filesystem::exists(std::filesystem::symlink_status(path)))
    throw InputError(fmt::format("{}: exists; choose another name, or remove it first", path));
  if (!std::filesystem::exists(std::filesystem::path(path).replace_filename("paper.json")) &&
      !data_path("experiments/paper.json"))
    throw InputError(
        "new: paper.json did not come with this program, and the new experiment extends it; "
        "install bristle with `cmake --install`, or use the program of a checkout");
  write_whole(path, replace_all(in_si ? kStartInSi : kStart, "NAME", name) + "\n",
              {"an experiment", "{", {}});
  experiment::load_experiment(path, {});
  fmt::print("{}: written; compute it with `bristle run {}`\n", path, path);
  return kSuccess;
}

}  // namespace bristle::cli
