#pragma once

#include "assumptions/matrix.hpp"

namespace bristle {

struct AssumptionsOptions {
  std::vector<std::string> files;  // of assumptions
  std::string experiments = "experiments";
  std::string output = "results/assumptions.json";  // the runs' own results go into a folder beside it
  std::string tier = "study";
  int threads = 0;  // 0: all cores
  bool quiet = false;
  std::string command_line;
};

// Runs every experiment of the folder that checks claims of the paper under every alternative and evaluates the
// checks. Results of earlier calls are used again. Throws InputError, or RunError if interrupted; the same call
// then continues.
Matrix run_assumptions(const AssumptionsOptions& options);

}  // namespace bristle
