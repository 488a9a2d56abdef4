#pragma once

#include "results/reader.hpp"
#include "json/json.hpp"

namespace bristle::archive {

// Returns facts about a result for README and metadata: {"name", "title", "figure", "tier", "payload_sha256",
// "numerics_version", "points", "provenance": {...}, "claims": [{"claim", "statement",
// "verdicts": {reading: verdict}}]}.
Json result_facts(const results::ResultReader& result);

// Returns result_facts() of an untrusted result file, which a separate process reads. Throws MalformedError
// if the payload or the experiment does not match its digest, or if the file has links, filters, or declared
// sizes beyond its stored data.
Json checked_result_facts(const std::string& bytes);

// Parses untrusted JSON. Throws MalformedError, without a file name, where parse_json() throws InputError.
Json parse_untrusted(const std::string& text);

// Returns the keys of a matrix of assumptions that describe it: numerics_version, inputs_sha256,
// payload_sha256, tier, only and program. A separate process reads the matrix. Throws MalformedError if it is
// not JSON, not a matrix, or changed.
Json checked_matrix_facts(const std::string& bytes);

}  // namespace bristle::archive
