#pragma once

#include "bristle/ensemble/point.hpp"
#include "bristle/words.hpp"

namespace bristle {

// Path of the slab (Fig. 3) to which a node of R_n(z_0) belongs. Under an increasing load (loading path,
// A-B-C-D) the slab takes the highest gap that carries the load; under a decreasing load (unloading path) it
// takes the lowest.
enum class Branch {
  unstable,
  loading,
  unloading,
  both,
  absent  // no node: the curve has fewer nodes than the result has room for
};
template <>
inline Words words<Branch>() {
  static constexpr const char* list[] = {"unstable", "loading", "unloading", "both", "absent"};
  return list;
}

struct CurveNode {
  PointResult result;
  Branch branch = Branch::unstable;
};

// Computes the curve R_n(z_0), with all other values, from first contact down to trace.to. Nodes are added
// until R_n deviates by at most trace.resolution from the straight line between neighbours, or until nodes at
// a jump are kClosest apart. Folds, and the gaps at which the slab lands after a jump from a fold, are
// located.
std::vector<CurveNode> trace_curve(const Setup& setup, const Trace& trace, const PassageRunner& run);

constexpr double kClosest = 1e-4;  // minimum distance of nodes in z_0, units of r0

}  // namespace bristle
