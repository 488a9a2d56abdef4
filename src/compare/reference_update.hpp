#pragma once

#include <string>

namespace bristle::compare {

struct ReferenceUpdate {
  std::string file, reason;
  std::string folder = "reference";
  std::string day;  // of the change, YYYY-MM-DD
};

// Writes the result to FOLDER/<name>.json as the new reference, and reason and changes to
// FOLDER/CHANGELOG.md. Returns the entry of the change log; empty if the reference has these numbers already,
// in which case nothing is written. Throws InputError, with the remedy, for an empty reason, for a result
// that is not a whole result of the smoke tier, and if the program or the work tree differs from its commit.
std::string update_reference(const ReferenceUpdate& update);

}  // namespace bristle::compare
