#pragma once

#include "archive/bag.hpp"
#include "experiment/document.hpp"

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

// Every hash and payload digest, nothing missing, added or changed, the metadata's required keys, and that
// the bytes are those that the program writes for these files. Throws InputError if there is no such file.
Verification verify_archive(const std::string& path);

}  // namespace bristle
