#pragma once

#include <string>

namespace bristle {

// Throws MalformedError unless an HDF5 file has only what result files have: groups, datasets and attributes that
// are stored in the file itself, unfiltered, and no larger than it. Nothing read afterwards can grow beyond
// the file or lead out of it.
void require_plain_hdf5(const std::string& path, std::size_t size);

}  // namespace bristle
