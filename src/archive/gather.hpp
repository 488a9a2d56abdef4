#pragma once

#include "archive/crate.hpp"

#include <ctime>

namespace bristle {

struct ArchiveOptions {
  std::string source = ".";  // the repository
  std::string results = "results", figures = "figures";
  std::string output;           // empty: dist/bristle-<version>.tar
  bool allow_dirty = false;     // archive as a draft what cannot be traced to a commit
  std::string version, commit;  // of this program
};

struct Gathered {
  Contents contents;
  std::string version;
  std::time_t time = 0;  // of the source commit
};

// Collects what is to be archived. Throws InputError that names what is missing, out of date, damaged or
// cannot be traced to a commit, and the remedy.
Gathered gather(const ArchiveOptions& options);

}  // namespace bristle
