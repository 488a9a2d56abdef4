#pragma once

#include "experiment/experiment.hpp"

namespace bristle {

// Everything that a point's numbers depend on, and nothing else, as JSON text: equal for equal points of any two
// experiments, whatever their names, axes and order. Choices are words, so that inserting a friction law
// does not change the meaning of stored keys.
std::string canonical_point(const Experiment& experiment, std::size_t index);

}  // namespace bristle
