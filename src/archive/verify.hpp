#pragma once

#include "archive/contents.hpp"
#include "json/json.hpp"

#include <nlohmann/json.hpp>

namespace bristle::archive {

// A result file of a verified archive and its result_facts().
struct VerifiedResult {
  std::string bytes;
  Json facts;
};

// Outcome of a verification.
struct Verification {
  Problems problems;  // empty: the archive is valid
  std::string folder, version, commit, identifier, draft;
  std::size_t files = 0;
  std::map<std::string, VerifiedResult> results;  // by name
};

// Checks all hashes and payload digests, and makes the archive again from its results, figures, documents and
// source: README, citation, crate, manifests and the tar itself must have the same bytes. The archive is not
// trusted and is not unpacked to disk. Throws InputError if it does not exist.
Verification verify_archive(const std::string& path);

}  // namespace bristle::archive
