#pragma once

#include "experiment/experiment.hpp"

namespace bristle::experiment {

// The table of /friction_law, the law of the word "custom"; null without it. Throws InputError for what is
// not a law, for a law that no point has, and for points with the word but no law.
std::shared_ptr<const ModulationTable> read_friction_law(const json::Document& document,
                                                         const std::vector<sweep::Axis>& axes);

}  // namespace bristle::experiment
