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

const char* to_string(Criterion criterion);

// A claim of the paper, measured on a result.
struct CheckResult {
  Check check;
  Measurement measured;
  double margin;  // distance from the threshold or from the end of the band, positive where the claim holds
  Verdict verdict;
};

// Evaluates the checks of the experiment stored in the result. Throws InputError for a check that names
// what the result does not have.
std::vector<CheckResult> evaluate_checks(const ResultReader& result);

// A table for people, one line per claim.
std::string checks_table(const std::vector<CheckResult>& checks);

}  // namespace bristle
