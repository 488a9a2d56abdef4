#pragma once

#include <string>

namespace bristle::archive {

struct ArchiveOptions {
  std::string source = ".";  // source repository
  std::string results = "results", figures = "figures";
  std::string report = "report/index.html";
  std::string output;           // empty: dist/bristle-<version>.tar
  bool allow_dirty = false;     // archive, as a draft, results that cannot be traced to a commit
  std::string version, commit;  // of this program
};

}  // namespace bristle::archive
