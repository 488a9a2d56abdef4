#pragma once

#include "bristle/words.hpp"

#include <array>
#include <functional>
#include <optional>

namespace bristle {

// R_n at a gap and its error estimate, per N_c0, dimensionless. Not finite if it could not be computed.
struct Load {
  double R_n, error;
  bool converged = true;  // whether the error is as small as was asked for
};
// Requested accuracy of R_n(z_0).
enum class Accuracy {
  rough,    // suffices to decide on which side of a distant target R_n lies
  precise,  // the same, and near the target that of the reported values
  reported  // that of the reported values, and the error includes the integrator's
};
using LoadCurve = std::function<Load(double z_0, Accuracy accuracy)>;

enum class LoadPath {
  loading,
  unloading
};
template <>
inline Words words<LoadPath>() {
  static constexpr const char* list[] = {"loading", "unloading"};
  return list;
}

enum class LoadStatus {
  reached,      // R_n(z_0) = target within rtol, or 3 rtol if even_between has a value
  load_jump,    // R_n(z_0) jumps across the target; z_0 and R_n are those after the jump
  unreachable,  // R_n stays below the target down to the ground (loading) or above it up to contact
                // (unloading)
  failed        // the curve could not be computed
};

// The wall is soft: bristles carry a load at gaps above first contact. Gaps higher than this number of wall
// ranges lambda_z above it are neither given nor searched: the wall's force falls to exp(-100) there.
constexpr double kWallRangesAboveContact = 100;

struct LoadSearch {
  double target = 2;  // R_n/N_c0
  LoadPath path = LoadPath::loading;
  double rtol = 1e-3;            // of R_n
  double first_contact = 0.985;  // sin(phi_0)
  double contact_range = 1e-3;   // contact_range() of the parameters
  double ground = 0.01;          // lowest z_0 of the search
  // Of the scan. Near the target it is an eighth of it; narrower humps of R_n(z_0) may be missed.
  double step = 0.05;
  double z_0_resolution = 1e-6;  // a crossing of the target within this is a jump
  // Whether values at the target may follow from secants to other gaps.
  bool by_secants = true;
};

struct LoadPoint {
  LoadStatus status = LoadStatus::unreachable;
  double z_0 = 0;
  Load load{};          // at z_0
  double z_0_near = 0;  // gaps of the scan before and after the crossing
  double z_0_far = 0;
  double jump_z_0 = 0;  // last gap before a jump, and its R_n
  double jump_R_n = 0;
  // Less than the errors, or than 0.5 % of the target, decides whether this crossing is the first: R_n(z_0)
  // has a maximum here, or before, that equals the target within that (a minimum on the unloading path).
  bool ambiguous = false;
  // The gap that is the first, if the loads are a little smaller or larger; none if no other gap carries the
  // target then.
  std::optional<double> z_0_other;
  // Computed gaps before and after z_0, if the load has similar slopes to both: the values at the target then
  // follow from secants to them.
  std::optional<std::array<double, 2>> even_between;
};

// Finds the gap at which R_n(z_0) first reaches the target when the slab is lowered from
// first contact (loading, path A-B-C-D of Fig. 3) or raised from the ground (unloading).
// R_n(z_0) may be non-monotonic and discontinuous. A scan brackets the first crossing,
// including one within a hump between gaps of the scan; a root-finder locates it.
LoadPoint first_crossing(const LoadCurve& curve, const LoadSearch& search);

}  // namespace bristle
