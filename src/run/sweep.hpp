#pragma once

#include "experiment/experiment.hpp"
#include "interface/trace.hpp"

#include <functional>

namespace bristle {

struct PointReport {
  std::size_t index;
  PointResult result;
  Recorded recorded;
  std::vector<CurveNode> curve;  // in place of the result, if the experiment traces curves
};

// Solves every point of the sweep on this many threads and hands the reports to sink, one at a time and
// in ascending order: what the sink sees does not depend on the threads. Memory is that of a few points.
// Ends early, returning false, once stop() is true.
bool run_sweep(const Experiment& experiment, int threads, const std::function<void(PointReport&&)>& sink,
               const std::function<bool()>& stop);

}  // namespace bristle
