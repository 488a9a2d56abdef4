#pragma once

#include "json/document.hpp"
#include "sweep/sweep.hpp"

namespace bristle::experiment {

// Throws InputError for a value that --set, or the experiment's own file, gives and that the sweep or the
// sample replaces at every point; the message names what replaces it.
void check_overrides(const json::Document& document);

// Returns a warning for each number of model, si and load that --set gives and that no point of the sweep
// depends on.
std::vector<std::string> idle_changes(const json::Document& document, const sweep::Sweep& sweep);

// Returns the place that sets a quantity, in its unit or in metres: its axis, a column of the sample, a
// variable of the design, or else its key in a block.
JsonPointer place_of(const json::Document& document, const std::string& quantity);

}  // namespace bristle::experiment
