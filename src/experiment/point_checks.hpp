#pragma once

#include "json/document.hpp"
#include "experiment/experiment.hpp"

namespace bristle::experiment {

// Checks what depends on several values of a point, at all points of the sweep: each quantity that is given
// or varies has a meaning, a gap is not above the reach of the contact at first contact, chi has a maximum if
// C asks for one, and a lattice fits the slab. Throws InputError with the place of the value.
void check_points(const json::Document& document, const Experiment& experiment);

// Throws InputError if shafts overlap at a point of the sweep of an experiment that gives their radius. A
// design may have such trials, which violate its constraint; so may its result, whose points no longer belong
// to a design.
void check_clearance(const json::Document& document, const Experiment& experiment);

// Returns a warning if shafts are too thick for a slender rod at a point of the sweep; empty otherwise.
std::vector<std::string> shaft_warnings(const json::Document& document, const Experiment& experiment);

}  // namespace bristle::experiment
