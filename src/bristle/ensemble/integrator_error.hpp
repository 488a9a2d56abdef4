#pragma once

#include "bristle/ensemble/ensemble.hpp"

namespace bristle {

// Estimates by how much the means of observables() deviate from those of exactly integrated passages. Repeats
// some of the passages with a tighter tolerance of the integrator: more of those that are sensitive to it,
// which are pinned, came near the pole or point against the motion. Where that would be all passages, they
// are repeated with two tolerances. task returns the task of a passage. effort: multiple of the usual number
// of repeated passages. The number of repetitions is added to count.
ObservableArray integrator_error(const std::vector<WeightedPassage>& passages, const Parameters& parameters,
                                 const std::function<PassageTask(const Passage&)>& task,
                                 const PassageRunner& run, std::size_t effort, long& count);

}  // namespace bristle
