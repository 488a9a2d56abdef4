#pragma once

#include "experiment/experiment.hpp"

namespace bristle::claims {

// Finds mistakes in checks before anything is computed: throws InputError if a check lacks a key that its
// predicate needs, or names a variable, an axis or a value that the result of the experiment will not have.
void validate_checks(const Experiment& experiment);

}  // namespace bristle::claims
