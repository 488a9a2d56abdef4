#pragma once

#include "archive/contents.hpp"

#include <ctime>

namespace bristle::archive {

struct ArchiveOptions {
  std::string source = ".";  // source repository
  std::string results = "results", figures = "figures";
  std::string report = "report/index.html";
  std::string output;           // empty: dist/bristle-<version>.tar
  bool allow_dirty = false;     // archive, as a draft, results that cannot be traced to a commit
  std::string version, commit;  // of this program
};

struct Gathered {
  Contents contents;
  std::time_t time = 0;  // of the source commit
};

// Collects and describes the contents of the archive. Throws InputError if a file is missing, out of date,
// damaged or cannot be traced to a commit.
Gathered gather(const ArchiveOptions& options);

}  // namespace bristle::archive
