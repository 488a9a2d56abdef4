#include "cli/commands.hpp"

#include "experiment/experiment.hpp"
#include "run/provenance.hpp"
#include "util/data.hpp"
#include "util/error.hpp"
#include "util/file.hpp"
#include "util/text.hpp"

#include <boost/algorithm/string/replace.hpp>
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
  "model: parameters of bristle, friction and slab, dimensionless; here of round rods with Hertz contact. load: R_n is the normal load over N_c0.",
  "orientation: rtol is the requested relative error of each mean over theta_0; the figures of the paper have 0.001.",
  "sweep: the axes of the result. An axis has values, or linspace or logspace with from, to and count."
 ],
 "model": {"bending": "rod", "contact": "hertz"},
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
  "si: the material of the paper's section 3 in SI units, as round rods with Hertz contact (bending, section and contact of model). docs/your-own-brush.md tells how to find each value; `bristle validate` prints the dimensionless ones.",
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
  "R_n_N": 0.6,
  "spacing_m": 0.0034,
  "L_x_m": 0.085
 },
 "orientation": {"rtol": 0.005},
 "sweep": {"V0_m_per_s": {"logspace": [3, 30, 7]}}
})";

// Computes the smoke tier of every experiment of a repository and compares it with the stored values.
constexpr const char* kCheckScript = R"(#!/bin/sh
# Computes the smoke tier of each experiment and compares it with the values in reference/.
set -eu
for file in *.json; do
  result=results/${file%.json}-smoke.h5
  bristle run "$file" --tier smoke -o "$result"
  bristle check "$result" --reference reference --report-only
done
)";

// The repository variable BRISTLE has the address, because the program does not know it.
constexpr const char* kWorkflow = R"(name: check
on: [push, pull_request]
jobs:
  check:
    runs-on: ubuntu-24.04
    container: debian:bookworm
    steps:
      - run: apt-get update && apt-get install -y --no-install-recommends git make ca-certificates
      - uses: actions/checkout@v4
      # The variable BRISTLE of the repository's settings has the address of bristle's repository.
      - run: git clone "$BRISTLE" /opt/bristleCHECKOUT && make -C /opt/bristle install
        env:
          BRISTLE: ${{ vars.BRISTLE }}
      - run: sh check.sh
)";

std::string checked_name(const std::string& given) {
  std::string name = given.ends_with(".json") ? given.substr(0, given.size() - 5) : given;
  if (name.starts_with(".") || name.starts_with("-"))
    throw InputError(fmt::format(
        "new: NAME {} is not allowed: an experiment is a file NAME.json, and `bristle new NAME --repository` "
        "makes a folder NAME; give a name that begins with a letter or a digit",
        Json(given).dump()));
  if (name.empty() || name.find_first_not_of(
                          "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_.-") != name.npos)
    throw InputError(
        fmt::format("new: NAME {} is not allowed; allowed: letters, digits, _ . -", Json(given).dump()));
  return name;
}

void write_experiment(const std::string& path, const std::string& name, bool in_si) {
  if (std::filesystem::exists(std::filesystem::symlink_status(path)))
    throw InputError(fmt::format("{}: exists; choose another name, or remove it first", path));
  if (!std::filesystem::exists(std::filesystem::path(path).replace_filename("paper.json")) &&
      !data_path("experiments/paper.json"))
    throw InputError(
        "new: paper.json did not come with this program, and the new experiment extends it; "
        "install bristle with `cmake --install`, or use the program of a checkout");
  write_whole(path, boost::replace_all_copy(std::string(in_si ? kStartInSi : kStart), "NAME", name) + "\n",
              {"an experiment", "{", {}});
  experiment::load_experiment(path, {});
}

// Writes the folder NAME with an experiment, the script that checks its numbers, and a workflow that runs it.
// Returns the exit code.
int new_repository(const std::string& program, const std::string& name, bool in_si) {
  if (std::filesystem::exists(std::filesystem::symlink_status(name)))
    throw InputError(fmt::format("{}: exists; choose another name, or remove it first", name));
  const std::string commit = boost::replace_all_copy(std::string(run::kCommit), "-dirty", "");
  const bool known = commit != "unknown";
  const std::string checkout = known ? fmt::format(" && git -C /opt/bristle checkout {}", commit) : "";
  write_experiment(fmt::format("{0}/{0}.json", name), name, in_si);
  write_whole(name + "/.gitignore", "results/\n", {"a list of files", "results/", {}});
  write_whole(name + "/check.sh", kCheckScript, {"a script", "#!/bin/sh", {}});
  write_whole(name + "/.github/workflows/check.yml",
              boost::replace_all_copy(std::string(kWorkflow), "CHECKOUT", checkout),
              {"a workflow", "name:", {}});
  const bool on_path = program.find('/') == program.npos;
  const std::string folder = std::filesystem::absolute(program).parent_path().lexically_normal().string();
  fmt::print(
      "{0}/: written, with an experiment, check.sh and a workflow for continuous integration. Next:\n"
      "{1}"
      "  cd {0} && git init && git add . && git commit -m \"An experiment\"\n"
      "  bristle run {0}.json --tier smoke\n"
      "  bristle reference update results/{0}-smoke.h5 --reason \"first values\"\n"
      "  git add reference && git commit -m \"Reference values\"\n"
      "  sh check.sh\n"
      "and, for the workflow, the repository variable BRISTLE: the address from which it clones bristle\n",
      name, on_path ? "" : fmt::format("  export PATH={}:\"$PATH\"\n", shell_quoted(folder)));
  if (!known)
    fmt::print("The workflow builds the newest bristle, because the commit of this program is not known.\n");
  return kSuccess;
}

}  // namespace

std::string new_experiment_path(const std::string& name) {
  return std::filesystem::is_directory("experiments") ? fmt::format("experiments/{}.json", name)
                                                      : name + ".json";
}

int new_command(const std::string& program, const std::string& given, bool in_si, bool repository) {
  const std::string name = checked_name(given);
  if (repository) return new_repository(program, name, in_si);
  const std::string path = new_experiment_path(name);
  write_experiment(path, name, in_si);
  fmt::print("{}: written; compute it with `{} run {}`\n", path, shell_quoted(program), path);
  return kSuccess;
}

}  // namespace bristle::cli
