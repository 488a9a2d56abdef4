#pragma once

#include "experiment/experiment.hpp"
#include "results/record.hpp"

#include <functional>

namespace bristle::run {

// The gap of a point.
struct Gap {
  bool known;              // false if the computation did not find the gap
  double z_0;              // in units of r0; NaN where no gap carries the load
  bool undecided = false;  // the point is ambiguous: within the errors the gap may be another one
};
Gap gap_of(const results::PointRecord& record);
// Returns true if the gap jumps between two neighbouring points: by more than 0.1 (in units of r0), or to
// where no gap carries the load.
bool jumps(const Gap& a, const Gap& b);

// Computes these points of a sweep, and returns their gaps in the same order.
using SolvePoints = std::function<std::vector<Gap>(const Sweep&, const std::vector<std::size_t>&)>;

// Finds where the gap z_0 of a load jumps along an axis of the sweep, by bisection. Returns the rows of the
// table "jumps", with their points in ascending order. A jump lies within an interval of 2 % of the axis
// value, so the middle of the interval is within 1 % of the jump. Across the interval z_0 changes by more
// than 0.1 (in units of r0), or a load becomes unreachable. The band of a jump extends over the computed
// points beside it that are ambiguous. gaps: the gaps of all points of the sweep, in order
results::Rows locate_jumps(const Sweep& sweep, const std::string& along, const std::vector<Gap>& gaps,
                           const SolvePoints& solve);

}  // namespace bristle::run
