#pragma once

#include <functional>

namespace bristle {

// R_n at a gap with its error estimate, both per N_c0, dimensionless. Not finite: could not be computed.
struct Load {
  double R_n, error;
};
// How R_n(z_0) is asked for: well enough to place it above or below a target that is far, or as well as can
// be.
enum class Accuracy {
  rough,
  precise
};
using LoadCurve = std::function<Load(double z_0, Accuracy accuracy)>;

enum class LoadPath {
  loading,
  unloading
};

enum class LoadStatus {
  reached,      // R_n(z_0) = target within rtol
  load_jump,    // R_n(z_0) jumps across the target; z_0 and R_n are those of the far side
  unreachable,  // no gap down to the ground carries (loading) or sheds down to (unloading) the target
  failed        // the curve could not be computed
};

struct LoadSearch {
  double target = 2;  // R_n/N_c0
  LoadPath path = LoadPath::loading;
  double rtol = 1e-3;            // of R_n
  double first_contact = 0.985;  // sin(phi_0)
  double ground = 0.01;          // lowest z_0 looked at
  double step = 0.05;            // of the scan: narrower humps of R_n(z_0) may be missed
  double z_0_resolution = 1e-6;  // a change across the target within this is a jump
};

struct LoadPoint {
  LoadStatus status = LoadStatus::unreachable;
  double z_0 = 0;
  Load load{};          // at z_0
  double z_0_near = 0;  // the scan's gaps before and behind the crossing
  double z_0_far = 0;
  double jump_z_0 = 0;  // last gap before a jump, and R_n there
  double jump_R_n = 0;
};

// The gap at which the target load is first met when the slab is lowered from first contact (loading, path
// A-B-C-D of Fig. 3) or raised from the ground (unloading). R_n(z_0) need not be monotonic nor continuous:
// a scan brackets the first crossing, humps that may hold one are searched, a root-finder locates it.
LoadPoint first_crossing(const LoadCurve& curve, const LoadSearch& search);

}  // namespace bristle
