#pragma once

#include "experiment/experiment.hpp"

#include <functional>

namespace bristle {

struct PointReport {
  std::size_t index;
  PointResult result;
  std::vector<Passage> bristles;  // of the final ensemble, if the experiment records them
};

// Solves every point of the sweep on this many threads and hands the reports to sink, one at a time and
// in ascending order: what the sink sees does not depend on the threads. Memory is that of a few points.
// Ends early, returning false, once stop() is true.
bool run_sweep(const Experiment& experiment, int threads, const std::function<void(PointReport&&)>& sink,
               const std::function<bool()>& stop);

}  // namespace bristle
