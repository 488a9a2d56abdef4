#pragma once

#include "archive/tar.hpp"
#include "util/json.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace bristle {

// One result: its file, the experiment files it was computed from (its own comes last), its figures, and its
// result_facts().
struct ArchivedResult {
  std::string file;
  std::vector<std::string> experiments, figures;
  Json facts;
};

// The payload of an archive and its description.
struct Contents {
  Files payload;                        // names as below data/
  std::vector<ArchivedResult> results;  // ascending by file
  Json citation;                        // of the dataset
  std::string commit, source;           // the source commit and the file that holds it
  std::string draft;                    // the reason why this must not be cited; empty: it may be
};

// Describes a payload that holds results (with facts by file), experiments, figures, documents and the source of a
// commit, and adds the files that follow from the rest: CITATION.cff, README.md and the crate. Verification calls
// it again and compares bytes. Throws MalformedError, naming the file, if something is missing.
Contents describe(Files payload, const std::map<std::string, Json>& facts, const std::string& commit,
                  const std::string& draft);

// The file that holds the source of a commit.
std::string source_file(const std::string& commit);

// The experiment's file and those that it extends, which come first, by their names in the payload.
std::vector<std::string> experiment_chain(const Files& payload, const std::string& file);

}  // namespace bristle
