#pragma once

#include "compare/comparison.hpp"
#include "util/json.hpp"

namespace bristle::compare {

// Notes, failures, a table of the differences, the remarks, and a summary in one line.
std::string comparison_text(const Comparison& comparison, const std::string& remarks = "");

// A comparison with a reference: counts, the five worst variables, failures and notes.
Json comparison_json(const Comparison& comparison);

}  // namespace bristle::compare
