#pragma once

#include "archive/contents.hpp"
#include "archive/options.hpp"

#include <ctime>

namespace bristle {

struct Gathered {
  Contents contents;
  std::string version;
  std::time_t time = 0;  // of the source commit
};

// Collects what is to be archived. Throws InputError that names what is missing, out of date, damaged or
// cannot be traced to a commit, and the remedy.
Gathered gather(const ArchiveOptions& options);

}  // namespace bristle
