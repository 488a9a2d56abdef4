#pragma once

#include "json/json.hpp"

#include <string>

namespace bristle::archive {

// The licence of everything in an archive except the program; the file LICENSE-DATA says so.
constexpr const char* kDataLicense = "CC-BY-4.0";

// Converts a CITATION.cff to JSON. Throws MalformedError if
// it is not a YAML object in UTF-8, or if it is too large.
Json parse_citation(const std::string& text);
std::string citation_text(const Json& citation);

// Derives the citation of the dataset from the citation of the software: it has the same authors, date and
// version, the DOI among the identifiers of the software, the licence of the data, and the software as the
// first reference. Throws MalformedError if one of these is missing; a DOI need not be there.
Json dataset_citation(const Json& software, const std::string& commit);

}  // namespace bristle::archive
