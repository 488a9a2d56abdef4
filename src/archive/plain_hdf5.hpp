#pragma once

#include <string>

namespace bristle::archive {

// Throws MalformedError unless an HDF5 file contains only what result files contain: groups, datasets and
// attributes that are stored in the file itself, unfiltered, and no larger than the file (size, in bytes).
// Later reads then neither need more memory than the size of the file nor follow links out of it.
void require_plain_hdf5(const std::string& path, std::size_t size);

}  // namespace bristle::archive
