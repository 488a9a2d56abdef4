#pragma once

#include "util/json.hpp"

#include <string>
#include <vector>

namespace bristle::experiment {

// The JSON schema of an experiment file as an author writes it, for editors: with `extends` blocks may be
// partial and null removes a key; without it the file is complete. The experiment schema describes the merged
// document; this one is made from it and from the table of what can be swept. predicates: the names that a
// check may use.
Json author_schema(const std::vector<std::string>& predicates);

}  // namespace bristle::experiment
