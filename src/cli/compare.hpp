#pragma once

#include "compare/comparison.hpp"
#include "compare/reference_update.hpp"

#include <string>

namespace bristle::cli {

struct CheckOptions {
  std::string file, reference;  // folder of the references; empty: ./reference, or else that of the program
  bool report_only = false;     // claims that are not supported are no failure
  bool claims_only = false;     // no comparison with the reference
  bool json = false;            // print JSON: deviations, and the command that computes each point again
};

struct DiffOptions {
  std::string a, b;
  compare::Tolerances tolerances;
};

// The commands `check`, `diff` and `reference update`. They
// return the exit code and throw InputError or RunError.
int check_command(const CheckOptions& options);
int diff_command(const DiffOptions& options);
int reference_update_command(compare::ReferenceUpdate update);

}  // namespace bristle::cli
