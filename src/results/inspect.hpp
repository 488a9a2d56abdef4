#pragma once

#include "results/hdf5.hpp"

#include <functional>
#include <string>
#include <vector>

namespace bristle::results {

// Reads a result file of unknown origin in a child process with limited time and memory, because libhdf5
// loops, crashes or fills the memory on some damaged files. Returns what is damaged in a file that can be
// read: the digests that do not match, and datasets of /checks that cannot be read; empty if the file is
// intact. open: opens the file; size: its size in bytes. Throws MalformedError if the file cannot be read, or
// is not as bristle writes it.
std::vector<std::string> damage_of(const std::function<h5::Handle()>& open, std::size_t size);

// Throws MalformedError unless an open HDF5 file contains only what result files contain: groups, datasets
// and attributes that are stored in the file itself, unfiltered, and no larger than the file (size, in
// bytes). Later reads then neither need more memory than the size of the file nor follow links out of it.
// Reads all attributes, because HDF5 may crash or loop on damaged ones: call it in a child process.
void require_plain_hdf5(hid_t file, std::size_t size);

// Returns the SHA-256 of names, types, shapes and values of the payload: all datasets outside /checks,
// /provenance and /failures. Reads texts: call it for a file of unknown origin only in a process of its own.
std::string payload_sha256(hid_t file);
// Returns the paths of the payload's datasets, in the order of the digest.
std::vector<std::string> payload_datasets(hid_t file);

}  // namespace bristle::results
