#pragma once

#include "run/parts.hpp"

#include <functional>

namespace bristle {

// Writes the parts' points as one result: numbers and digest are those of a run of the whole, checks are
// evaluated, /provenance lists the parts. Nothing is left and an existing output is as it was if this throws:
// InputError for missing or contradicting points, or an output that is one of the parts; RunError once
// stop() is true.
void merge_parts(PartSet& parts, const std::string& output, const std::string& command_line,
                 const std::function<bool()>& stop);

// What the parts' runs have in common, or each of their values; when they began and ended; a line per part.
std::map<std::string, std::string> merged_provenance(const std::vector<Part>& parts);

}  // namespace bristle
