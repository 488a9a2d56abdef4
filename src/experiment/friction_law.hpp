#pragma once

#include "experiment/experiment.hpp"

namespace bristle::experiment {

// The law of the word "custom".
struct OwnLaw {
  std::shared_ptr<const ModulationTable> table;  // null if the experiment has no such law
  bool in_si = false;                            // whether its speeds are in m/s, and not in units of V0
};

// Reads the block /friction_law. Throws InputError for what is not a law, for a law that no point has, and
// for points with the word but no law.
OwnLaw read_friction_law(const json::Document& document, const std::vector<sweep::Axis>& axes);

}  // namespace bristle::experiment
