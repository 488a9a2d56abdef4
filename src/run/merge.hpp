#pragma once

#include "run/parts.hpp"

#include <functional>

namespace bristle::run {

// Writes the points of the parts as one result. Numbers and digest are those of an unsharded run; checks are
// evaluated; /provenance lists the parts. Throws InputError for missing or contradictory points, or if the
// output is one of the parts; throws RunError when stop() is true. If it throws, it leaves no partial file,
// and an existing output is unchanged.
void merge_parts(PartSet& parts, const std::string& output, const std::string& command_line,
                 const std::function<bool()>& stop);

// Provenance of a merged result: for each entry the values of all
// parts, the earliest start, the latest end, and one line per part.
std::map<std::string, std::string> merged_provenance(const std::vector<Part>& parts);

}  // namespace bristle::run
