#pragma once

#include "archive/options.hpp"

namespace bristle {

struct BuiltArchive {
  std::string path, sha512, draft;
  std::size_t files = 0, bytes = 0;
};

// Gathers, writes under a temporary name, verifies what was written, and gives it its name. Equal inputs give
// equal bytes. Throws InputError for what cannot be archived or written there.
BuiltArchive build_archive(const ArchiveOptions& options);

}  // namespace bristle
