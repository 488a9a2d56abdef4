#pragma once

#include "experiment/experiment.hpp"
#include "sweep/si.hpp"

#include <string>
#include <vector>

namespace bristle::experiment {

// Reads the document's si block into input.si. Throws InputError if a dimensionless value that the block
// replaces is swept as well, or if the block is incomplete.
void read_si_units(const json::Document& document, const std::vector<sweep::Axis>& axes,
                   sweep::PointInput& input);

// Returns warnings about an experiment in SI units: values that the author gives although the block replaces
// them, and a load that is not in newtons.
std::vector<std::string> si_warnings(const json::Document& document, const Experiment& experiment);

}  // namespace bristle::experiment
