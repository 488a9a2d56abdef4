#pragma once

#include "claims/checks.hpp"
#include "compare/comparison.hpp"
#include "json/json.hpp"

#include <nlohmann/json.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace bristle::compare {

constexpr const char* kReferences = "reference";  // name of the folder in a checkout

// The numbers, tolerances and verdicts of an experiment that later results are compared with. A file in JSON
// holds them (CONTRIBUTING.md, reference.schema.json). Errors are omitted because they become tolerances, and
// counts such as passages because they are cost, not result.
struct Reference {
  Json about;                // the file without axes, sample, flags and variables
  results::Dataset numbers;  // codes (flags) and real numbers (variables) over the axes
  std::map<std::string, std::vector<double>> tolerances;  // tolerances of the real numbers, by name
  std::optional<std::vector<results::Array>> sample;      // columns of the sample, if the file states them

  std::string text(const std::string& name) const;
};

// Returns the reference made from a result and its verdicts. Throws InputError for a variable that does not
// extend over all points.
Reference make_reference(const results::ResultReader& result, const std::vector<claims::CheckResult>& checks);

// Returns the text of a reference's file.
std::string file_text(const Reference& reference);

// Reads the text of a file. Throws InputError with path and JSON pointer for every mistake.
Reference parse_reference(const std::string& text, const std::string& path);
// Reads the reference file at path as parse_reference() does. Messages say how to restore the file.
Reference read_reference(const std::string& path);

// Returns the path of the reference of an experiment: FOLDER/<name>.json.
std::string reference_path(const std::string& folder, const std::string& name);

// Compares a result, which may have more points, with a reference. Compares verdicts between equal points
// only, because verdicts may depend on the points. label: names the reference in messages
Comparison compare_with_reference(const results::ResultReader& result,
                                  const std::vector<claims::CheckResult>& checks, const Reference& reference,
                                  const std::string& label);

// Returns the commands that make a reference from the smoke tier of a result's experiment or, if this tier
// has too many points, that it needs fewer. made: reference with the points of the result; most_bytes: of a
// reference; options: of the command that updates the reference
std::string smoke_commands(const results::ResultReader& result, const Reference& made,
                           std::uintmax_t most_bytes, const std::string& options = "");

struct ReferenceUpdate {
  std::string file, reason;
  std::string folder = kReferences;
  std::string day;                            // day of the change, YYYY-MM-DD
  std::uintmax_t most_bytes = kMaxJsonBytes;  // of the reference: no more are read
};

// Writes the result to FOLDER/<name>.json as the new reference, and reason and changes to
// FOLDER/CHANGELOG.md. Returns the entry of the change log; empty if the reference has these numbers already,
// in which case nothing is written. Throws InputError, with the remedy, for an empty reason, for a result
// that is not a whole result of the smoke tier, for one that is too large, and if the program or the work
// tree differs from its commit.
std::string update_reference(const ReferenceUpdate& update);

}  // namespace bristle::compare
