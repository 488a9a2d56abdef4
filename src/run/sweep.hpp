#pragma once

#include "experiment/experiment.hpp"
#include "results/record.hpp"

#include <functional>

namespace bristle {

struct PointReport {
  std::size_t index;
  PointRecord record;
};

// Solves these points of the sweep on this many threads and hands each report to sink as it is done, one at a
// time and in any order; the numbers do not depend on the threads nor on what else is computed. Ends early,
// returning false, once stop() is true. Throws what sink throws.
bool run_sweep(const Experiment& experiment, const std::vector<std::size_t>& points, int threads,
               const std::function<void(PointReport&&)>& sink, const std::function<bool()>& stop);

}  // namespace bristle
