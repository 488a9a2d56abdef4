#pragma once

#include "archive/gather.hpp"

namespace bristle::archive {

struct BuiltArchive {
  std::string path, sha512, draft;
  std::size_t files = 0, bytes = 0;
};

// Gathers the files, writes the archive under a temporary name, verifies it, and renames it. Equal inputs
// give equal bytes. Throws InputError if an input cannot be archived, or the output cannot be written.
BuiltArchive build_archive(const ArchiveOptions& options);

}  // namespace bristle::archive
