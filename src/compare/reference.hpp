#pragma once

#include "claims/checks.hpp"
#include "compare/comparison.hpp"
#include "util/json.hpp"

namespace bristle::compare {

constexpr const char* kReferences = "reference";  // the folder of a checkout

// A reference is the JSON document of CONTRIBUTING.md: numbers, tolerances and verdicts of an experiment
// that later results are compared with (reference.schema.json).

// The reference made from a result and its verdicts. Errors are omitted because they become tolerances, and
// counts such as passages because they are cost, not result. Throws InputError for a variable that is not
// over all points.
Json make_reference(const results::ResultReader& result, const std::vector<claims::CheckResult>& checks);

// Throws InputError with file and JSON pointer for every mistake.
Json read_reference(const std::string& path);

// Path of the reference of an experiment: FOLDER/<name>.json.
std::string reference_path(const std::string& folder, const std::string& name);

// Compares a result, which may have more points, with a reference. Verdicts are compared between equal points
// only, because they may depend on them. label: names the reference in messages.
Comparison compare_with_reference(const results::ResultReader& result,
                                  const std::vector<claims::CheckResult>& checks, const Json& reference,
                                  const std::string& label);

// The commands that make a reference from the smoke tier of a result's experiment. options: of the update.
std::string smoke_commands(const results::ResultReader& result, const std::string& options = "");

struct ReferenceUpdate {
  std::string file, reason;
  std::string folder = kReferences;
  std::string day;  // of the change, YYYY-MM-DD
};

// Writes the result to FOLDER/<name>.json as the new reference, and reason and changes to
// FOLDER/CHANGELOG.md. Returns the entry of the change log; empty if the reference has these numbers already,
// in which case nothing is written. Throws InputError, with the remedy, for an empty reason, for a result
// that is not a whole result of the smoke tier, and if the program or the work tree differs from its commit.
std::string update_reference(const ReferenceUpdate& update);

}  // namespace bristle::compare
