#pragma once

#include "experiment/experiment.hpp"
#include "results/record.hpp"

#include <functional>

namespace bristle::run {

struct PointReport {
  std::size_t index;
  results::PointRecord record;
};

// Functions that the scheduler calls while it computes, one call at a time.
struct SchedulerObserver {
  // Receives the index of a point that takes unusually long, and its seconds of processor time so far.
  std::function<void(std::size_t, double)> slow = [](std::size_t, double) {};
  // Receives the number of passages computed since the last call, which may be 0.
  std::function<void(std::size_t)> passages = [](std::size_t) {};
};

// Returns the number of cores of this machine.
int all_cores();

// Solves these points of the sweep on `threads` threads. Passes the report of each point to sink when the
// point is solved, one at a time, in any order. The numbers depend neither on the threads nor on the other
// points. An error within a point becomes its status. Returns false early when stop() becomes true. Throws
// the exceptions of sink.
bool run_sweep(const Sweep& sweep, const std::vector<std::size_t>& points, int threads,
               const std::function<void(PointReport&&)>& sink, const std::function<bool()>& stop,
               const SchedulerObserver& observer = {});

}  // namespace bristle::run
