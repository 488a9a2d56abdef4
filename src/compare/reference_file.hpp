#pragma once

#include "compare/reference.hpp"

#include <string>

namespace bristle::compare {

constexpr const char* kReferenceSchema = "bristle-reference/1";

// Deterministic JSON text with one array per line. All numbers read back exactly.
std::string reference_text(const Reference& reference);

// Throws InputError with file and JSON pointer for every mistake.
Reference read_reference(const std::string& path);

// Path of the reference of an experiment: FOLDER/<name>.json.
std::string reference_path(const std::string& folder, const std::string& name);

}  // namespace bristle::compare
