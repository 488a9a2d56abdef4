#pragma once

#include "json/json.hpp"

#include <array>
#include <memory>
#include <string>
#include <utility>
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

// Ranges [from, to] of axes, within which these experiments are checked.
struct Window {
  std::string name;
  std::vector<std::pair<std::string, std::array<double, 2>>> where;
  std::vector<std::string> experiments;
};

struct Declarations {
  Alternative baseline;                   // its changes apply under every alternative
  std::vector<Alternative> alternatives;  // in the files' order, then the combinations
  std::vector<Window> windows;            // one without ranges if the files have none
};

// Reads these files. Throws InputError for a file that does not match the schema, for duplicate names, and
// for unknown members of a combination.
Declarations read_declarations(const std::vector<std::string>& files);

}  // namespace bristle::assumptions
