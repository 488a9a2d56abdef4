#pragma once

#include "bristle/ensemble/load.hpp"
#include "bristle/ensemble/load_rules.hpp"

#include <algorithm>
#include <optional>
#include <vector>

namespace bristle {

// R_n at one gap. excess is R_n minus the target on the loading path, the target minus R_n on the unloading
// path: negative before the crossing.
struct GapLoad {
  double z_0;
  Load load;
  double excess;
};

// Two gaps on the path. They enclose a crossing if the excess is negative at near and not negative at far.
struct LoadBracket {
  GapLoad near, far;
  bool encloses() const { return near.excess < 0 && far.excess >= 0; }
};

// The loads that a search computes along its path.
class LoadsOnPath {
 public:
  struct NotComputable {};

  LoadsOnPath(const LoadCurve& curve, const LoadSearch& search) : search(search), curve_(curve) {}

  // Throws NotComputable.
  GapLoad at(double z_0, Accuracy accuracy);
  LoadBracket between(double near, double far, Accuracy accuracy) {
    return {at(near, accuracy), at(far, accuracy)};
  }
  GapLoad one_step_beyond(double z_0, Accuracy accuracy);  // a step of the scan, but within the path
  const std::vector<GapLoad>& computed() const { return computed_; }

  // The gap that lies beyond z_0 on the path by this distance, or before it if the distance is negative.
  double beyond(double z_0, double distance) const {
    return z_0 + (search.path == LoadPath::loading ? -distance : distance);
  }
  // The gaps before z_0 on the path, and those beyond it.
  bool is_before(double one, double z_0) const {
    return search.path == LoadPath::loading ? one > z_0 : one < z_0;
  }
  double allowed() const { return search.rtol * search.target; }
  // Within this distance from the target, the fluctuation of the loads decides on which side of it they lie.
  double undecided(const GapLoad& at) const {
    return std::max(kUndecidedShare * search.target, kUndecidedErrors * at.load.error);
  }

  const LoadSearch& search;

 private:
  const LoadCurve& curve_;
  std::vector<GapLoad> computed_;
};

// Scans the path for its first crossing of the target, at gaps a step apart and within humps of R_n(z_0)
// between them. The loads of the bracket are precise. None if the path does not cross the target.
std::optional<LoadBracket> scan_for_crossing(LoadsOnPath& loads);

}  // namespace bristle
