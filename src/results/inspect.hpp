#pragma once

#include "results/hdf5.hpp"

#include <functional>
#include <string>
#include <vector>

namespace bristle::results {

// Reads a result file of unknown origin in a child process with limited time and memory, because libhdf5
// loops, crashes or fills the memory on some damaged files. Returns what is damaged in a file that can be
// read: the digests that do not match, and datasets of /checks that cannot be read; empty if it is intact.
// open: opens the file; size: in bytes. Throws MalformedError if it cannot be read, or is not as bristle
// writes it.
std::vector<std::string> damage_of(const std::function<h5::Handle()>& open, std::size_t size);

}  // namespace bristle::results
