#pragma once

#include "json/json.hpp"

#include <string>

namespace bristle::results {

// Returns the document of an experiment with sorted keys, whose order in the file does not matter, and
// without the sample of a design, whose points follow from the rest and are stored with the result.
nlohmann::json without_trials(const Json& document);

// Returns the SHA-256 of the part of an experiment's document that determines the numbers: everything except
// name, title, figure, institution, notes and checks.
std::string inputs_sha256(const Json& document);

}  // namespace bristle::results
