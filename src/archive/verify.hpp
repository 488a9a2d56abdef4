#pragma once

#include "archive/bag.hpp"
#include "util/json.hpp"

#include <nlohmann/json.hpp>

namespace bristle {

// A result file of a sound archive and what result_facts says of it.
struct VerifiedResult {
  std::string bytes;
  Json facts;
};

// What verification found. The archive is not trusted; nothing of it is unpacked to disk.
struct Verification {
  Problems problems;  // empty: the archive is sound
  std::string folder, version, commit, identifier, draft;
  std::size_t files = 0;
  std::map<std::string, VerifiedResult> results;  // by name
};

// Checks every hash and payload digest; that nothing is missing, added or changed; that README, citation and crate
// are those that follow from the other files; and that the bytes are those that the program writes for these
// files. Throws InputError if the archive does not exist.
Verification verify_archive(const std::string& path);

}  // namespace bristle
