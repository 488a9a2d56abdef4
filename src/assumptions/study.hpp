#pragma once

#include "assumptions/matrix.hpp"

namespace bristle {

struct StudyOptions {
  std::vector<std::string> files;  // of assumptions
  std::string experiments = "experiments";
  std::string output = "results/assumptions.json";  // the runs' own results go into a folder beside it
  std::string tier = "study";
  int threads = 0;  // 0: all cores
  bool quiet = false;
  std::string command_line;
};

// Runs every experiment of the folder that has checks of the paper's claims under every alternative, and
// evaluates the checks. What earlier studies computed is not computed again. Throws InputError, or RunError
// if interrupted: the same call goes on.
Matrix study(const StudyOptions& options);

}  // namespace bristle
