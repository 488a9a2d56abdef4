#pragma once

#include "json/json.hpp"

#include <memory>
#include <string>
#include <vector>

namespace bristle::assumptions {

// An alternative to the baseline for one choice that the paper leaves open, or for several together, as
// declared in experiments/assumptions/*.json (schema: src/assumptions/assumption.schema.json).
struct Alternative {
  std::string name, choice, description;
  std::vector<std::string> members;  // of a combination: the names of its alternatives; else empty
  std::vector<std::shared_ptr<const Json>> declarations;  // one for each member; empty for the baseline

  // Applies the declarations to an experiment's document. Throws InputError if a JSON pointer has no value.
  Json apply(const std::string& experiment, Json document) const;
};

// Reads the alternatives of these files, in the files' order, then the combinations. The first is the
// baseline, which changes nothing. Throws InputError for a file that does not match the schema, for duplicate
// names, and for unknown members of a combination.
std::vector<Alternative> read_alternatives(const std::vector<std::string>& files);

}  // namespace bristle::assumptions
