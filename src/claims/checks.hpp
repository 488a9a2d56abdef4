#pragma once

#include "claims/predicates.hpp"
#include "experiment/experiment.hpp"

namespace bristle {

// Outcome of a check or a claim. undecided: the threshold lies within the uncertainty of the measurement, too
// few points have values, a trend is not significant, or no check decides the claim. depends: of a claim,
// some interpretations are supported and others are not.
enum class Verdict {
  supported,
  refuted,
  undecided,
  depends
};
template <>
inline Words words<Verdict>() {
  static constexpr const char* list[] = {"supported", "refuted", "undecided", "depends"};
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
  // supported if all its main checks are supported, and refuted if one of them is refuted. If all
  // interpretations have one verdict, it is the claim's. If some are supported, the claim depends on what is
  // meant. It is undecided otherwise, and if it has no main check.
  Verdict claim_verdict;
};

// The verdict on a claim under one reading.
struct ClaimVerdict {
  std::string claim, reading;
  Verdict verdict;
};

// Returns the verdicts on the claims, in the order of their first checks.
std::vector<ClaimVerdict> claim_verdicts(const std::vector<CheckResult>& checks);

// Evaluates the checks of the experiment that is stored in the result. checks_file: a JSON file, such as an
// experiment, whose checks replace the checks of the result; empty for none. Throws InputError if a check
// names a variable, an axis or a value that the result does not have.
std::vector<CheckResult> evaluate_checks(const results::ResultReader& result,
                                         const std::string& checks_file = "");

// Returns the name that pages and figures give to a model of bending: "corrected" for "polar". Returns
// another reading as it is.
std::string name_of_reading(const std::string& reading);

// Returns what a check requires, in words: "95 % of the points", "last over first value at most 0.5".
std::string required_text(const Check& check);
// Returns what was measured, in the words of required_text(): "100 % of the points", "0.230 +- 0.001".
std::string found_text(const CheckResult& check);

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
