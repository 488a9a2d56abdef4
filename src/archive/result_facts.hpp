#pragma once

#include "results/reader.hpp"
#include "util/json.hpp"

namespace bristle {

// What README and metadata tell of a result: {"name", "title", "figure", "tier", "numerics_version",
// "points", "payload_sha256", "provenance": {...}, "checks": [{"claim", "statement", "verdict"}]}.
Json result_facts(const ResultReader& result);

// The same of a result file that is not trusted, read in a process of its own. Throws MalformedError if it is no
// sound result: a payload or an experiment that is not that of its digest, links, filters, declared sizes
// that the file does not hold.
Json checked_result_facts(const std::string& bytes);

// JSON that is not trusted: throws MalformedError, without a file name, where parse_json() throws InputError.
Json parse_untrusted(const std::string& text);

}  // namespace bristle
