#pragma once

#include "run/sweep.hpp"
#include "scratch.hpp"

#include <numeric>

namespace bristle::testing {

// Computes all points of an experiment, in order of their indices.
inline std::vector<PointRecord> all_records(const Experiment& e, int threads = 1) {
  std::vector<PointRecord> records(e.points());
  std::vector<std::size_t> points(e.points());
  std::iota(points.begin(), points.end(), 0);
  run_sweep(
      e, points, threads, [&](PointReport&& r) { records[r.index] = std::move(r.record); },
      [] { return false; });
  return records;
}

}  // namespace bristle::testing
