#pragma once

#include "archive/tar.hpp"

namespace bristle {

// Reads what write_tar wrote. The file is not trusted: nothing but plain files under relative names of the
// portable characters, in order and once each, no larger than the archive itself; nothing is unpacked to
// disk. Throws MalformedError for all else, InputError if there is no such file.
Files read_tar(const std::string& path);

}  // namespace bristle
