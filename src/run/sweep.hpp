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
// one at a time, in any order. The numbers depend neither on the threads nor on the other points. An error
// within a point becomes its status. Returns false early when stop() becomes true. Calls slow, if given, with
// the index of a point that takes unusually long and with the seconds so far. Throws the exceptions of sink.
bool run_sweep(const Experiment& experiment, const std::vector<std::size_t>& points, int threads,
               const std::function<void(PointReport&&)>& sink, const std::function<bool()>& stop,
               const std::function<void(std::size_t, double)>& slow = {});

}  // namespace bristle::run
