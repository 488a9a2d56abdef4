#pragma once

#include "bristle/ensemble/load.hpp"
#include "bristle/ensemble/load_rules.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace bristle {

// R_n at one gap. excess is R_n minus the target on the loading path and the target minus R_n on the
// unloading path, so that it is negative before the crossing.
struct GapLoad {
  double z_0;
  Load load;
  double excess;
};

// Two gaps on the path, near before far. They enclose a crossing if the excess is negative at near and not
// negative at far.
struct LoadBracket {
  GapLoad near, far;
  bool encloses() const { return near.excess < 0 && far.excess >= 0; }
};

// The loads that a search computes along its path.
class LoadsOnPath {
 public:
  struct NotComputable {};

  LoadsOnPath(const LoadCurve& curve, const LoadSearch& search) : search(search), curve_(curve) {}

  // Computes the load at a gap. Throws NotComputable if the load is not finite.
  GapLoad at(double z_0, Accuracy accuracy);
  LoadBracket between(double near, double far, Accuracy accuracy) {
    return {at(near, accuracy), at(far, accuracy)};
  }
  // Computes the load one step of the scan beyond z_0, or at the end of the path if that is nearer.
  GapLoad one_step_beyond(double z_0, Accuracy accuracy);
  const std::vector<GapLoad>& computed() const { return computed_; }

  // Returns the gap that lies beyond z_0 on the path by `distance`, or before z_0 if `distance` is negative.
  double beyond(double z_0, double distance) const {
    return z_0 + (search.path == LoadPath::loading ? -distance : distance);
  }
  // Returns whether the gap `one` lies before z_0 on the path.
  bool is_before(double one, double z_0) const {
    return search.path == LoadPath::loading ? one > z_0 : one < z_0;
  }
  // Returns the accepted distance of R_n from the target.
  double allowed() const { return search.rtol * search.target; }
  // Returns the distance from the target within which the error or the fluctuation of the load leaves open on
  // which side of the target it lies.
  double undecided(const GapLoad& at) const {
    return std::max(kUndecidedShare * search.target, kUndecidedErrors * at.load.error);
  }

  const LoadSearch& search;

 private:
  const LoadCurve& curve_;
  std::vector<GapLoad> computed_;
};

// Scans the path for its first crossing of the target, at gaps a step apart and within humps of R_n(z_0)
// between them. Returns a bracket with precise loads, or none if the path does not cross the target.
std::optional<LoadBracket> scan_for_crossing(LoadsOnPath& loads);

}  // namespace bristle
