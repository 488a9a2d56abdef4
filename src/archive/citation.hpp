#pragma once

#include "util/json.hpp"

#include <string>

namespace bristle::archive {

// Converts a CITATION.cff to JSON. Throws MalformedError if
// it is not a YAML object in UTF-8, or if it is too large.
Json parse_citation(const std::string& text);
std::string citation_text(const Json& citation);

// Derives the citation of the dataset from that of the software: it has the same authors, licence, date and
// version, and the software as a reference. Throws MalformedError if one of these is missing.
Json dataset_citation(const Json& software, const std::string& commit);

}  // namespace bristle::archive
