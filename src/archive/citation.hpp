#pragma once

#include "util/json.hpp"

#include <string>

namespace bristle {

// A CITATION.cff as JSON. Throws MalformedError if it is not a YAML object in UTF-8, or is nested too deeply.
Json parse_citation(const std::string& text);
std::string citation_text(const Json& citation);

// The citation of the dataset, from that of the software: the same authors, licence, date and version; the
// software becomes a reference. Throws MalformedError if the software's citation lacks one of these.
Json dataset_citation(const Json& software, const std::string& commit);

}  // namespace bristle
