#pragma once

#include "run/sweep.hpp"

#include <optional>

namespace bristle {

// Where a worker's points come from and go to; called from several threads.
class PointQueue {
 public:
  virtual ~PointQueue() = default;
  // The next point's index; none once there is no more to do.
  virtual std::optional<std::size_t> next() = 0;
  virtual void deliver(PointReport&& report) = 0;
  virtual bool stopped() = 0;
};

// Solves points on this thread until the queue has none. With the fast engine several are under way at a
// time, at most the thread's share of all, each on a stack of its own: a point that waits for passages leaves
// the lanes to the others'.
void work(const Experiment& experiment, PointQueue& queue, std::size_t share);

}  // namespace bristle
