#pragma once

#include "run/task.hpp"

namespace bristle::design {

// Throws InputError if the objective or a constraint of the design names a variable that the result lacks.
// Does nothing without a design.
void validate_design(const Experiment& experiment);

// Searches for the best values of the variables in the experiment's block "design". Writes all trials and the
// findings to the result file, whose sweep is a sample of the trials. Does not compute trials again that are
// in the result's journal. Prints the recommended values in words unless options.quiet is set. Returns false
// if no trial meets the constraints or has a value, and prints the nearest miss; also if the recommended
// brush, as made, violates a constraint. Throws as run_experiment().
bool run_design(const Experiment& experiment, const run::RunOptions& options);

}  // namespace bristle::design
