#pragma once

#include "experiment/experiment.hpp"

namespace bristle::experiment {

// Exactly the input that determines a point's numbers, as text: the same text for equal points of any two
// experiments, regardless of names, axes and their order. Choices are written as words, so that inserting
// or reordering friction laws does not change the meaning of stored keys.
std::string canonical_point(const Experiment& experiment, std::size_t index);

}  // namespace bristle::experiment
