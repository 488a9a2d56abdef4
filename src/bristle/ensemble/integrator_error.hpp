#pragma once

#include "bristle/ensemble/ensemble.hpp"

namespace bristle {

// Estimates the deviation of the means of observables() from the means of exactly integrated passages.
// Repeats a sample of the passages with a tighter tolerance of the integrator, preferably bristles that are
// sensitive to it: they are pinned, came near the pole or point against the motion. If the sample would
// contain all passages, they are repeated with two tolerances. `task` returns the task of a passage. `effort`
// is a multiple of the usual number of repeated passages. The number of repetitions is added to `count`.
ObservableArray integrator_error(const std::vector<WeightedPassage>& passages, const Parameters& parameters,
                                 const std::function<PassageTask(const Passage&)>& task,
                                 const PassageRunner& run, std::size_t effort, long& count);

}  // namespace bristle
