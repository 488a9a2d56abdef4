#pragma once

#include "run/passage_pool.hpp"
#include "run/sweep.hpp"

#include <optional>

namespace bristle::run {

// Source of the points and destination of the reports of the workers. Called from several threads.
class PointQueue {
 public:
  virtual ~PointQueue() = default;
  // Index of the next point; none if there are no more.
  virtual std::optional<std::size_t> next() = 0;
  virtual bool all_started() = 0;
  virtual void deliver(PointReport&& report) = 0;
  // Counts passages that have been computed. Returns true if the thread must end.
  virtual bool stopped(std::size_t passages) = 0;
};

// Solves points on this thread until the queue is empty. With the SIMD engine several points, at most share,
// are active at a time, each with its own stack: while a point waits for passages, the lanes compute those of
// other points. Then it computes passages of the pool until all threads have solved their points.
void run_worker(const Experiment& experiment, PointQueue& queue, PassagePool& pool, std::size_t share);

}  // namespace bristle::run
