#pragma once

#include "experiment/experiment.hpp"
#include "results/record.hpp"

#include <functional>

namespace bristle::run {

struct PointReport {
  std::size_t index;
  results::PointRecord record;
};

// Solves these points of the sweep on this many threads. Passes each report to sink when its point is solved,
// one at a time, in any order. The numbers depend neither on the threads nor on the other points. Returns
// false early when stop() becomes true. Throws the exceptions of sink.
bool run_sweep(const Experiment& experiment, const std::vector<std::size_t>& points, int threads,
               const std::function<void(PointReport&&)>& sink, const std::function<bool()>& stop);

}  // namespace bristle::run
