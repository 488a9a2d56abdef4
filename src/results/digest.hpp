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

// The document of an experiment with sorted keys, whose order in the file does not matter, and without the
// sample of a design, whose points follow from the rest and are stored with the result.
nlohmann::json without_trials(const Json& document);

// SHA-256 of the part of an experiment's document that determines the numbers: everything except name, title,
// figure, institution, notes and checks.
std::string inputs_sha256(const Json& document);

}  // namespace bristle::results
