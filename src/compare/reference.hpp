#pragma once

#include "claims/checks.hpp"
#include "compare/comparison.hpp"
#include "util/json.hpp"

#include <nlohmann/json.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace bristle::compare {

constexpr const char* kReferences = "reference";  // the folder of a checkout

// The numbers, tolerances and verdicts of an experiment that later results are compared with. A file in JSON
// holds them (CONTRIBUTING.md, reference.schema.json). Errors are omitted because they become tolerances, and
// counts such as passages because they are cost, not result.
struct Reference {
  Json about;                // of the file: all but axes, sample, flags and variables
  results::Dataset numbers;  // over the axes: codes (flags) and real numbers (variables)
  std::map<std::string, std::vector<double>> tolerances;  // of the real numbers, by name
  std::optional<std::vector<results::Array>> sample;      // its columns, if the file states them

  std::string text(const std::string& name) const;
};

// Returns the reference made from a result and its verdicts. Throws InputError for a variable that is not
// over all points.
Reference make_reference(const results::ResultReader& result, const std::vector<claims::CheckResult>& checks);

// Returns the text of a reference's file.
std::string file_text(const Reference& reference);

// Reads the text of a file. Throws InputError with path and JSON pointer for every mistake.
Reference parse_reference(const std::string& text, const std::string& path);
// The same for a file; the message says how to restore it.
Reference read_reference(const std::string& path);

// Path of the reference of an experiment: FOLDER/<name>.json.
std::string reference_path(const std::string& folder, const std::string& name);

// Compares a result, which may have more points, with a reference. Verdicts are compared between equal points
// only, because they may depend on them. label: names the reference in messages.
Comparison compare_with_reference(const results::ResultReader& result,
                                  const std::vector<claims::CheckResult>& checks, const Reference& reference,
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
