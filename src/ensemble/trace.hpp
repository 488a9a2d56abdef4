#pragma once

#include "ensemble/point.hpp"

namespace bristle {

// Where a node of R_n(z_0) lies on the slab's paths (Fig. 3): lowered under a growing load it takes the
// highest gap that carries it (A-B-C-D), raised under a falling load the lowest.
enum class Branch {
  unstable,
  loading,
  unloading,
  both,
  absent  // there is no such node
};

struct CurveNode {
  PointResult result;
  Branch branch = Branch::unstable;
};

// R_n(z_0) and all other values from first contact down to trace.to, in that order. Nodes are added until R_n
// departs from the straight line between neighbours by trace.resolution at most, or they are kClosest apart:
// a jump. Folds are located, and so are the gaps at which the slab lands when it jumps from one.
std::vector<CurveNode> trace_curve(const Setup& setup, const Trace& trace, const PassageRunner& run);

constexpr double kClosest = 1e-4;  // in units of r0

}  // namespace bristle
