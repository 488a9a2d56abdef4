#pragma once

#include "experiment/document.hpp"
#include "results/reader.hpp"

namespace bristle {

// What README and metadata tell of a result: {"name", "title", "figure", "tier", "numerics_version",
// "points", "payload_sha256", "provenance": {...}, "checks": [{"claim", "statement", "verdict"}]}.
Json result_facts(const ResultReader& result);

// The same of a result file that is not trusted, read in a process of its own. Throws BadArchive if it is no
// sound result: a payload or an experiment that is not that of its digest, links, filters, declared sizes
// that the file does not hold.
Json checked_result_facts(const std::string& bytes);

// A message without the name of a temporary file, which says nothing to its reader.
std::string without_path(std::string text, const std::string& path);

}  // namespace bristle
