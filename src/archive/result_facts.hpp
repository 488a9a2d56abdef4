#pragma once

#include "results/reader.hpp"
#include "json/json.hpp"

namespace bristle::archive {

// Facts about a result for README and metadata: {"name", "title", "figure", "tier", "numerics_version",
// "points", "payload_sha256", "provenance": {...}, "claims": [{"claim", "statement",
// "verdicts": {reading: verdict}}]}.
Json result_facts(const results::ResultReader& result);

// The same for an untrusted result file, read in a separate process. Throws
// MalformedError if the payload or the experiment does not match its digest,
// or if the file has links, filters, or declared sizes beyond its stored data.
Json checked_result_facts(const std::string& bytes);

// Parses untrusted JSON. Throws MalformedError, without a file name, where parse_json() throws InputError.
Json parse_untrusted(const std::string& text);

// The keys of a matrix of assumptions that describe it: numerics_version, inputs_sha256, payload_sha256,
// tier, only and program. In a child process, too. Throws MalformedError if it is not JSON, not a matrix, or
// changed.
Json checked_matrix_facts(const std::string& bytes);

}  // namespace bristle::archive
