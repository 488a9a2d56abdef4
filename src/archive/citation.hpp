#pragma once

#include "archive/bag.hpp"
#include "experiment/document.hpp"

namespace bristle {

// A CITATION.cff as JSON. Throws BadArchive if it is not YAML of an object, or is nested too deeply.
Json parse_citation(const std::string& text);
std::string citation_text(const Json& citation);

// The dataset's citation, from that of the software: same authors, licence, date and version; the software
// itself becomes a reference.
Json dataset_citation(const Json& software, const std::string& commit);

// What keeps a citation from being one of a dataset in Citation File Format 1.2.0.
Problems check_citation(const Json& citation);

}  // namespace bristle
