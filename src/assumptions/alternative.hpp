#pragma once

#include "util/json.hpp"

#include <memory>
#include <string>
#include <vector>

namespace bristle {

// An alternative to the baseline for one choice that the paper leaves open, or for several together, as declared
// in experiments/assumptions/*.json (schema: src/assumptions/assumption.schema.json).
struct Alternative {
  std::string name, choice, description;
  std::vector<std::string> members;                    // of a combination: the names of its alternatives
  std::vector<std::shared_ptr<const Json>> declarations;  // one for each member

  // The experiment's document under this alternative. Throws InputError if a pointer leads nowhere.
  Json apply(const std::string& experiment, Json document) const;
};

// The alternatives of these files in their order, then the combinations. Throws InputError for a file that does
// not match the schema, for a name that is used twice, and for unknown members.
std::vector<Alternative> read_alternatives(const std::vector<std::string>& files);

}  // namespace bristle
