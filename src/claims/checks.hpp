#pragma once

#include "claims/predicates.hpp"
#include "experiment/experiment.hpp"

namespace bristle {

// Outcome of a check or a claim. undecided: the threshold lies within the uncertainty of the measurement, too
// few points have values, or a trend is not significant.
enum class Verdict {
  supported,
  refuted,
  undecided
};
template <>
inline Words words<Verdict>() {
  static constexpr const char* list[] = {"supported", "refuted", "undecided"};
  return list;
}

namespace claims {

// The check of a claim of the paper, evaluated on a result.
struct CheckResult {
  Check check;
  Measurement measured;
  double margin;  // distance from the threshold or from the end of the band; positive if the claim holds
  Verdict verdict;
  // Verdict on the claim under this check's reading, by the main checks of the claim. An interpretation is
  // supported if all its main checks are supported, and refuted if one of them is refuted. The claim is
  // supported if one of its interpretations is supported, and refuted if all are refuted.
  Verdict claim_verdict;
};

// The verdict on a claim under one reading.
struct ClaimVerdict {
  std::string claim, reading;
  Verdict verdict;
};

// Returns the verdicts on the claims, in the order of their first checks.
std::vector<ClaimVerdict> claim_verdicts(const std::vector<CheckResult>& checks);

// Evaluates the checks of the experiment that is stored in the result. within: ranges [from, to] that limit
// axes, except axes that a check selects or compares. checks_file: a JSON file, such as an experiment, whose
// checks replace the checks of the result; empty for none. Throws InputError if a check names a variable, an
// axis or a value that the result does not have.
std::vector<CheckResult> evaluate_checks(
    const results::ResultReader& result,
    const std::vector<std::pair<std::string, std::array<double, 2>>>& within = {},
    const std::string& checks_file = "");

// Returns the name that pages and figures give to a model of bending: "corrected" for "polar". Returns
// another reading as it is.
std::string name_of_reading(const std::string& reading);

// Returns the checks for people, in lines of at most `columns` characters: what each states, and below it the
// verdict and the measured number for each reading. Leaves out further checks unless `all` is set.
std::string checks_table(const std::vector<CheckResult>& checks, bool all, std::size_t columns);

// Finds mistakes in checks before anything is computed: throws InputError if a check lacks a key that its
// predicate needs, or names a variable, an axis or a value that the result of the experiment will not have.
void validate_checks(const Experiment& experiment);
// Finds mistakes in these checks of the experiment, as above.
void validate_checks(const Experiment& experiment, const std::vector<Check>& checks);

}  // namespace claims
}  // namespace bristle
