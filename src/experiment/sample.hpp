#pragma once

#include "json/document.hpp"
#include "sweep/sweep.hpp"

namespace bristle::experiment {

// Returns the axis of /sweep/sample: the rows of a table, or a Sobol sequence over distributions of
// quantities (docs/experiments.md). Throws InputError as read_axes() does.
sweep::Axis read_sample(const json::Document& document);

}  // namespace bristle::experiment
