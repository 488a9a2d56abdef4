#pragma once

#include "bristle/words.hpp"

#include <array>
#include <functional>
#include <optional>

namespace bristle {

// R_n at a gap and its estimated error, per N_c0, dimensionless. R_n is not finite if it could not be
// computed.
struct Load {
  double R_n, error;
  bool converged = true;  // whether the error is as small as was asked for
};
// Requested accuracy of R_n(z_0).
enum class Accuracy {
  rough,    // suffices to decide on which side of a distant target R_n lies
  precise,  // as rough; near the target, as accurate as the reported values
  reported  // as accurate as the reported values; the error includes the integrator's
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
  load_jump,    // R_n(z_0) jumps across the target; z_0 and R_n are the values after the jump
  unreachable,  // R_n stays below the target down to the ground (loading) or above it up to contact
                // (unloading)
  failed        // the curve could not be computed
};

// Bounds how far above first contact a gap may be given or searched, in wall ranges lambda_z. The wall is
// soft, so that bristles carry a load there; its force falls to exp(-100) at this height.
constexpr double kWallRangesAboveContact = 100;

struct LoadSearch {
  double target = 2;  // R_n/N_c0
  LoadPath path = LoadPath::loading;
  double rtol = 1e-3;            // accepted relative distance of R_n from the target
  double first_contact = 0.985;  // sin(phi_0)
  double contact_range = 1e-3;   // contact_range() of the parameters
  double ground = 0.01;          // lowest z_0 of the search
  // Distance between the gaps of the scan; near the target it falls to an eighth of this. Narrower humps of
  // R_n(z_0) may be missed.
  double step = 0.05;
  double z_0_resolution = 1e-6;  // R_n jumps if it crosses the target within less than this
  // Allows the caller to take the values at the target from secants to other gaps.
  bool by_secants = true;
};

struct LoadPoint {
  LoadStatus status = LoadStatus::unreachable;
  double z_0 = 0;
  Load load{};          // at z_0
  double z_0_near = 0;  // gap of the scan before the crossing
  double z_0_far = 0;   // gap of the scan after the crossing
  double jump_z_0 = 0;  // last gap before a jump, and its R_n
  double jump_R_n = 0;
  // Set if the errors, or 0.5 % of the target, leave open which crossing comes first, because R_n(z_0) has a
  // maximum near the target at or before this gap (on the unloading path a minimum).
  bool ambiguous = false;
  // The gap of the first crossing if the loads are a little smaller or larger than computed; none if no other
  // gap carries the target then.
  std::optional<double> z_0_other;
  // Computed gaps before and after z_0 to which the load has similar slopes: the values at the target follow
  // from secants to these gaps. None if the slopes differ.
  std::optional<std::array<double, 2>> even_between;
};

// Finds the gap at which R_n(z_0) first reaches the target when the slab is lowered from
// first contact (loading, path A-B-C-D of Fig. 3) or raised from the ground (unloading).
// R_n(z_0) may be non-monotonic and discontinuous. A scan brackets the first crossing,
// including one within a hump between gaps of the scan; a root-finder locates it.
LoadPoint first_crossing(const LoadCurve& curve, const LoadSearch& search);

}  // namespace bristle
