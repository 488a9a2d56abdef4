#pragma once

#include <hdf5.h>
#include <cstddef>

namespace bristle::results {

// Throws MalformedError unless an open HDF5 file contains only what result files contain: groups, datasets
// and attributes that are stored in the file itself, unfiltered, and no larger than the file (size, in
// bytes). Later reads then neither need more memory than the size of the file nor follow links out of it.
// Reads all attributes, because HDF5 may crash or loop on damaged ones: call it in a child process.
void require_plain_hdf5(hid_t file, std::size_t size);

}  // namespace bristle::results
