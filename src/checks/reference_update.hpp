#pragma once

#include <string>

namespace bristle {

struct ReferenceUpdate {
  std::string file, reason;
  std::string folder = "reference";
  std::string day;  // for the record
};

// Makes the result FOLDER/<name>.json and puts on record, in FOLDER/CHANGELOG.md, why and what changed.
// Returns the record's entry; empty if the reference says the same already, and then nothing is written.
// Throws InputError, naming what is wrong and the remedy, for a reason that is none, a result that is not
// whole or not the smoke tier's, a program or a work tree that is no commit.
std::string update_reference(const ReferenceUpdate& update);

}  // namespace bristle
