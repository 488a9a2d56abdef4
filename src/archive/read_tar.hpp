#pragma once

#include "archive/tar.hpp"

namespace bristle::archive {

// Reads an archive of write_tar() into memory. The file is not trusted: it may contain only plain files, in
// order and once each, with relative names of portable characters, and no larger than the archive. Throws
// MalformedError for anything else, InputError if the file does not exist.
Files read_tar(const std::string& path);

}  // namespace bristle::archive
