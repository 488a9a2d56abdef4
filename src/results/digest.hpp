#pragma once

#include "util/json.hpp"

#include <hdf5.h>
#include <string>
#include <vector>

namespace bristle::results {

// SHA-256 of names, types, shapes and values of the payload: all datasets outside /checks and /provenance.
// It reads texts: of a file of unknown origin only in a process of its own.
std::string payload_sha256(hid_t file);
// Paths of these datasets, in the order of the digest.
std::vector<std::string> payload_datasets(hid_t file);

// SHA-256 of the part of an experiment's document that determines the numbers: everything except name, title,
// figure, institution, notes and checks.
std::string inputs_sha256(const Json& document);

}  // namespace bristle::results
