#pragma once

#include "ensemble/ensemble.hpp"

namespace bristle {

// Estimates by how much the means of observables() deviate from those of exactly integrated passages. Repeats
// some of the passages with a tighter tolerance of the integrator: more of those that are sensitive to it,
// which are pinned, were reflected at the pole or needed the implicit method. task returns the task of a
// passage. Adds the number of repeated passages to count.
ObservableArray integrator_error(const std::vector<WeightedPassage>& passages, const Parameters& parameters,
                                 const std::function<PassageTask(const Passage&)>& task,
                                 const PassageRunner& run, long& count);

}  // namespace bristle
