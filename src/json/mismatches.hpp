#pragma once

#include "json/json.hpp"

namespace bristle::json {

// Places where a value does not match a schema, each as valijson names it: "<root>", "[model]", "[k_r]".
using Mismatches = std::vector<std::vector<std::string>>;

// Returns the mismatches of a value and those above them, which follow from them; none if it matches.
Mismatches mismatches(const Json& schema, const Json& value);

}  // namespace bristle::json
