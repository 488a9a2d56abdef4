#pragma once

#include "experiment/experiment.hpp"

namespace bristle {

// Throws InputError if a check lacks what its predicate needs, or names a variable, an axis or a value that
// the experiment's result will not have: before anything is computed.
void validate_checks(const Experiment& experiment);

}  // namespace bristle
