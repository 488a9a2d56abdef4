#pragma once

#include "archive/contents.hpp"
#include "archive/options.hpp"

#include <ctime>

namespace bristle::archive {

struct Gathered {
  Contents contents;
  std::string version;
  std::time_t time = 0;  // of the source commit
};

// Collects and describes the contents of the archive. Throws InputError if a file is missing, out of date,
// damaged or cannot be traced to a commit.
Gathered gather(const ArchiveOptions& options);

}  // namespace bristle::archive
