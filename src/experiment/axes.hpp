#pragma once

#include "experiment/experiment.hpp"

namespace bristle::experiment {

// The sweep's axes with all their values. Throws InputError for an unknown parameter, an empty or unsorted
// axis, a value outside the parameter's range, and more than kMaxPoints points in total.
std::vector<Axis> read_axes(const Document& document);

constexpr double kMaxPoints = 1e7;

}  // namespace bristle::experiment
