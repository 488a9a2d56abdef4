#pragma once

#include "results/hdf5.hpp"
#include "util/sha.hpp"

#include <string>
#include <vector>

// Datasets of texts: the words of a swept choice, and columns of /checks. Their texts have a variable length,
// because the netCDF library crashes on arrays of texts of fixed length.
namespace bristle::results {

h5::Handle create_texts(hid_t parent, const std::string& name, const std::vector<std::string>& texts);
bool is_text(hid_t dataset);

// Adds the texts of a dataset to the digest, each with a zero at its end. HDF5 trusts the lengths that the
// file states: call it for a file of unknown origin only in a process of its own.
void add_texts(Digest& digest, hid_t dataset);

}  // namespace bristle::results
