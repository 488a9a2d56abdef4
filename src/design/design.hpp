#pragma once

#include "run/task.hpp"

namespace bristle::design {

// Throws InputError if an objective or a constraint of a design names a variable that the result, or the
// result of the second model, does not have. Does nothing without a design.
void validate_design(const Experiment& experiment);

// Looks for the best values of the variables of the experiment's block "design", and writes all trials and
// what they show into the result file: its sweep is a sample with the trials. Trials that are in its journal
// are not computed again. Prints the recommended values in words unless quiet. Returns false if no trial
// meets the constraints or has a value; the nearest miss is printed. Throws as run_experiment().
bool run_design(const Experiment& experiment, const run::RunOptions& options);

}  // namespace bristle::design
