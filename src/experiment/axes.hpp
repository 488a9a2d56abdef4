#pragma once

#include "experiment/experiment.hpp"

namespace bristle {

// The sweep's axes, expanded. Throws InputError: unknown parameter, empty or unsorted axis, a value outside
// the parameter's range, more points in all than kMostPoints.
std::vector<Axis> read_axes(const Document& document);

constexpr double kMostPoints = 1e7;

}  // namespace bristle
