#pragma once

#include "experiment/experiment.hpp"

#include <string>
#include <vector>

namespace bristle {

// Another way to settle what the paper leaves open, or several together, as declared in
// experiments/assumptions/*.json (schema: src/assumptions/assumption.schema.json).
struct Alternative {
  std::string name, choice, description;
  std::vector<std::string> members;  // of several taken together: their names
  std::vector<Json> declared;        // the declarations, one for each member

  // The experiment's document under this alternative. Throws InputError if a pointer leads nowhere.
  Json apply(const std::string& experiment, Json document) const;
};

// The alternatives of these files, in their order; several together last. Throws InputError for whatever is
// wrong with a file, for a name that is used twice, and for members that are not there.
std::vector<Alternative> read_alternatives(const std::vector<std::string>& files);

}  // namespace bristle
