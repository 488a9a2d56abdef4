#pragma once

#include "bristle/model/equations.hpp"

namespace bristle {

// Quantities that results report about a passage beyond the integrals of Component (dynamics/ode.hpp).
// Neither the motion nor the size of a step depends on them. Dimensionless.
enum PathQuantity {
  STUCK_TIME,        // on the slab with V_R below V_s, the static branch of chi
  OFF_SLAB_TIME,     // see is_off_slab()
  SQUARED_LOAD,      // integral of F_n^2
  SLIDING_WORK,      // integral of F_f V_R
  LOAD_PEAK,         // largest F_n
  STRETCH_PEAK,      // largest r - 1, at least 0
  COMPRESSION_PEAK,  // largest 1 - r, at least 0
  BENDING_PEAK,      // largest 1 - cos of the angle between the bristle and the undeformed one
  TRAVEL_PEAK,       // largest distance of the tip from its start along the motion, r0
  IMPACTS,           // number of steps after which a tip that was off the slab is on it
  OFF_SLAB,          // whether the tip is off the slab: 1 or 0
  PATH_QUANTITIES
};
template <class T>
using Path = std::array<T, PATH_QUANTITIES>;

template <class T, class P>
auto is_off_slab(const Bristle<P>& b, const T& z) {
  return T(b.off_slab) < T(b.z_0 - z);
}

// Adds the integrands at one instant to the path. weight is the weight of the instant in a quadrature of high
// order over time. share is its weight in a quadrature with positive weights, for the times, whose integrands
// jump between 0 and 1.
template <class T, class P>
void add_instant(const Bristle<P>& b, const T& z, const ContactForce<T>& contact, const Sliding<T>& sliding,
                 const std::array<T, 2>& friction, const T& weight, const T& share, Path<T>& path) {
  const auto off = is_off_slab(b, z);
  path[OFF_SLAB_TIME] += select(off, share, T(0.0));
  path[STUCK_TIME] += select(off, T(0.0), select(sliding.V_R < b.V_s, share, T(0.0)));
  path[SQUARED_LOAD] += weight * T(contact.F_n * contact.F_n);
  path[SLIDING_WORK] -= weight * T(friction[0] * sliding.V_x + friction[1] * sliding.V_y);
  path[LOAD_PEAK] = max(path[LOAD_PEAK], contact.F_n);
}

// Updates the largest values and the number of impacts in the path. position is the tip's position at the
// start of a step, frame the frame there, and x_0 the tip's x at the start of the passage.
template <class T, class P>
void add_position(const Bristle<P>& b, const Vector3<T>& position, const Frame<T>& frame, const T& x_0,
                  Path<T>& path) {
  const T along_e_s = b.cos_theta_0 * position[0] + b.sin_theta_0 * position[1];
  const T cosine = T(b.cos_phi_0 * along_e_s + b.sin_phi_0 * position[2]) * frame.one_r;
  path[STRETCH_PEAK] = max(path[STRETCH_PEAK], T(frame.r - 1.0));
  path[COMPRESSION_PEAK] = max(path[COMPRESSION_PEAK], T(1.0 - frame.r));
  path[BENDING_PEAK] = max(path[BENDING_PEAK], T(1.0 - cosine));
  path[TRAVEL_PEAK] = max(path[TRAVEL_PEAK], T(position[0] - x_0));
  const T off = select(is_off_slab(b, position[2]), T(1.0), T(0.0));
  path[IMPACTS] += path[OFF_SLAB] * T(1.0 - off);
  path[OFF_SLAB] = off;
}

}  // namespace bristle
