#pragma once

#include "run/scheduler.hpp"
#include "scratch.hpp"

#include <numeric>

namespace bristle::testing {

// Computes all points of an experiment, in order of their indices.
inline std::vector<PointRecord> all_records(const Experiment& e, int threads = 1) {
  std::vector<PointRecord> records(e.sweep.size());
  std::vector<std::size_t> points(e.sweep.size());
  std::iota(points.begin(), points.end(), 0);
  run_sweep(
      e.sweep, points, threads, [&](PointReport&& r) { records[r.index] = std::move(r.record); },
      [] { return false; });
  return records;
}

}  // namespace bristle::testing
