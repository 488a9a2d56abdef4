#pragma once

#include "experiment/experiment.hpp"

namespace bristle {

// Everything that a point's numbers depend on, and nothing else: the same object for equal points of any two
// experiments, whatever their names, axes and order.
nlohmann::json canonical_point(const Experiment& experiment, std::size_t index);

}  // namespace bristle
