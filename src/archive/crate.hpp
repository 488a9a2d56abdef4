#pragma once

#include "archive/bag.hpp"
#include "experiment/document.hpp"

// RO-Crate 1.1 with the profile Process Run Crate 0.5: the payload's metadata, ro-crate-metadata.json.
namespace bristle {

constexpr const char* kCrateFile = "ro-crate-metadata.json";

// One result: its file, the experiment files it was computed from (the last is its own), its figures, and
// what result_facts says of it.
struct ArchivedResult {
  std::string file;
  std::vector<std::string> experiments, figures;
  Json facts;
};

// What is archived: the payload without its crate, and what describes it.
struct Contents {
  Files payload;
  std::vector<ArchivedResult> results;  // in the figures' order
  Json citation;                        // of the dataset
  std::string commit, source;           // the source commit and the file that holds it
  std::string draft;                    // why this is not to be cited; empty: it is
};

std::string crate_text(const Contents& contents);

// Holds a bag's crate against the RO-Crate and profile's requirements, its files (without the bag's folder),
// its citation, and facts: what the result files themselves say, by their names in the bag.
Problems check_crate(const Json& crate, const Files& files, const Json& citation,
                     const std::map<std::string, Json>& facts);

}  // namespace bristle
