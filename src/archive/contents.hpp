#pragma once

#include "archive/bag.hpp"
#include "json/json.hpp"

#include <ctime>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace bristle::archive {

// One result: its file, the experiment files from which it was
// computed (its own is the last), its figures, and its result_facts().
struct ArchivedResult {
  std::string file;
  std::vector<std::string> experiments, figures;
  Json facts;
};

// The payload of an archive and its description.
struct Contents {
  Files payload;                        // names relative to data/
  std::vector<ArchivedResult> results;  // ascending by file
  Json citation;                        // of the dataset
  std::string commit, source;           // the source commit and the file that contains it
  std::time_t time = 0;                 // of the commit
  std::string draft;                    // why the archive must not be cited; empty if it may be cited
};

// Describes a payload of results (with facts by file), experiments, figures,
// documents and the source of a commit, and adds the files that are generated from
// these: CITATION.cff, README.md and the crate. Verification calls it again and
// compares bytes. Throws MalformedError, naming the file, if a file is missing.
Contents describe(Files payload, const std::map<std::string, Json>& facts, const std::string& commit,
                  std::time_t time, const std::string& draft);

// Returns the name of the folder of the archive.
std::string folder_of(const Contents& contents);
// Returns all files of the archive: the payload and the tag files of the bag.
Files bag_of(const Contents& contents);

// Returns the name in the payload of the source of a commit.
std::string source_file(const std::string& commit);

// Returns README.md of the archive: src/archive/README.md.in with the tables of results and of claims.
std::string archive_readme(const Contents& contents);

// Returns the names in the payload of an experiment file and of the files that it extends, which come first.
std::vector<std::string> experiment_chain(const Files& payload, const std::string& file);

}  // namespace bristle::archive
