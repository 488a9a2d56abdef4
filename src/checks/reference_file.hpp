#pragma once

#include "checks/reference.hpp"

#include <string>

namespace bristle {

constexpr const char* kReferenceSchema = "bristle-reference/1";

// JSON, the same text for the same reference: one array per line, numbers that read back to the bit.
std::string reference_text(const Reference& reference);

// Throws InputError naming file and JSON pointer for whatever is not a reference.
Reference read_reference(const std::string& path);

// Where an experiment's reference lies: FOLDER/<name>.json.
std::string reference_path(const std::string& folder, const std::string& name);

}  // namespace bristle
