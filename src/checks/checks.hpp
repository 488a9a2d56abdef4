#pragma once

#include "checks/predicates.hpp"
#include "experiment/experiment.hpp"

namespace bristle {

// undecided: the threshold lies within the measurement's uncertainty, too few points have values, or a trend
// of so few points may be chance.
enum class Verdict {
  supported,
  refuted,
  undecided
};
const char* to_string(Verdict verdict);

// A claim of the paper against a result.
struct CheckResult {
  std::string claim, statement;
  Measurement measured;
  std::string is;  // at_most, at_least, or near: within band of
  double threshold, band;
  double margin;  // distance from the threshold or the band's end, positive on the claim's side
  Verdict verdict;
};

// Throws InputError if a check lacks what its predicate needs, or names a variable, an axis or a value that
// the experiment's result will not have: before anything is computed.
void validate_checks(const Experiment& experiment);

// Evaluates the checks of the experiment stored in the result. Throws InputError for a check that names
// what the result does not have.
std::vector<CheckResult> evaluate_checks(const ResultReader& result);

// Replaces the group /checks of a result file by these.
void write_checks(const std::string& path, const std::vector<CheckResult>& checks);

// A table for people, one line per claim.
std::string checks_table(const std::vector<CheckResult>& checks);

}  // namespace bristle
