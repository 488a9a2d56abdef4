#pragma once

#include "util/json.hpp"

namespace bristle::experiment {

// The JSON schema of an experiment file as an author writes it, for editors: with `extends` blocks may be
// partial and null removes a key; without it the file is complete. The experiment schema describes the merged
// document; this one is made from it and from the table of what can be swept.
Json author_schema();

}  // namespace bristle::experiment
