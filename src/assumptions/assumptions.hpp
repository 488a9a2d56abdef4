#pragma once

#include "assumptions/matrix.hpp"
#include "run/scheduler.hpp"

namespace bristle::assumptions {

struct AssumptionsOptions {
  std::vector<std::string> files;  // declarations of alternatives, see alternative.hpp
  std::string experiments = "experiments";
  std::vector<std::string> only;  // names of experiments; all if empty
  // File of the matrix. The results of the runs go to a folder of that name without .json.
  std::string output = "results/assumptions.json";
  std::string tier = "study";
  int threads = run::all_cores();
  bool quiet = false;
  std::vector<std::string> arguments;  // of the command line
};

// Runs every experiment of the folder that has checks of claims of the paper under
// every alternative, and evaluates the checks. Reuses results of earlier calls.
// Throws InputError, or RunError if interrupted; the same call then continues.
Matrix run_assumptions(const AssumptionsOptions& options);

// Looks for mistakes in the declarations and the experiments, without computing anything: every alternative
// must leave every experiment and its checks valid. Throws InputError.
void validate_assumptions(const AssumptionsOptions& options);

// Returns the SHA-256 of all that determines the matrix: the declarations in options.files, in any order, the
// experiments that would be run, and numerics_version. Throws InputError as run_assumptions() does.
std::string inputs_sha256(const AssumptionsOptions& options);

}  // namespace bristle::assumptions
