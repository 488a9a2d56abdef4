#pragma once

#include "bristle/model/elementary.hpp"
#include "bristle/model/parameters.hpp"

namespace bristle {

template <class P>
struct Bristle;  // model/bristle.hpp

// Returns the force of a short-range exponential repulsion, Eqs. (3, 4): strength/(2 range)
// exp(-distance/range). Dimensionless. peak is strength/(2 range), rate is 1/range.
template <class T, class P>
T short_range_force(const T& distance, const P& peak, const P& rate) {
  const T exponent = -distance * rate;
  return peak * T(decay(exponent));
}

// Returns the potential of short_range_force(), whose negative derivative by the distance is the force.
// Dimensionless energy.
template <class T, class P>
T short_range_energy(const T& distance, const P& peak, const P& rate) {
  return short_range_force(distance, peak, rate) / rate;
}

// Normal force between slab and tip, and its power 2/3 (for the Hertzian contact area). Dimensionless.
template <class T>
struct ContactForce {
  T F_n;
  T F_n_23;  // F_n^(2/3)
};

// Returns the force of the wall, Eq. (3), at `distance` = z_0 - z. One exponential gives both powers:
// root_peak is the cube root of the peak, root_rate a third of the rate.
template <class T, class P>
ContactForce<T> wall_force(const T& distance, const P& root_peak, const P& root_rate) {
  const T exponent = -distance * root_rate;
  const T root = root_peak * T(decay(exponent));
  const T square = root * root;
  return {T(square * root), square};
}

// Returns stiffness depth^(3/2), the force of a sphere that is pressed into the slab by depth >= 0 (Hertz).
// stiffness is hertz_stiffness(); stiffness_23 is stiffness^(2/3).
template <class T, class P>
ContactForce<T> hertz_force(const T& depth, const P& stiffness, const P& stiffness_23) {
  constexpr double regular =
      1e-60;  // keeps the root's derivative finite at depth 0, and vanishes in rounding
  const T root = depth * T(inverse_sqrt(T(depth + regular)));
  return {T(stiffness * T(depth * root)), T(stiffness_23 * depth)};
}

// Returns (4/3) E* R_c^(1/2), the force on a tip of radius R_c and contact modulus E_star at depth 1, by
// Hertz. Dimensionless.
inline double hertz_stiffness(double R_c, double E_star) { return 4 * E_star * std::sqrt(R_c) / 3; }

// Returns how deep a tip at the height z is pressed into a slab at the gap b.z_0, in units of r0: 0 below the
// slab.
template <class T, class P>
T contact_depth(const Bristle<P>& b, const T& z) {
  const T depth = z - b.z_0;
  return select(T(0.0) < depth, depth, T(0.0));
}

// Returns the force between the slab and a tip at the height z, by the law b.contact.
template <class T, class P>
ContactForce<T> contact_force(const Bristle<P>& b, const T& z) {
  if (b.contact == Contact::hertz)
    return hertz_force(contact_depth(b, z), b.hertz_stiffness, b.hertz_stiffness_23);
  return wall_force(T(b.z_0 - z), b.wall_root_peak, b.wall_root_rate);
}

// Returns the energy of the contact at the height z. Its derivative by z is F_n of contact_force(); with
// Hertz's law the energy is 2/5 F_n depth. Dimensionless.
template <class T, class P>
T contact_energy(const Bristle<P>& b, const T& z) {
  if (b.contact == Contact::hertz) return T(0.4 * contact_force(b, z).F_n) * contact_depth(b, z);
  return short_range_energy(T(b.z_0 - z), b.wall_peak, b.wall_rate);
}

// Returns the derivative by the height z of F_n of contact_force(); with Hertz's law it is 3/2 stiffness
// depth^(1/2). Dimensionless.
template <class P>
double contact_stiffness(const Bristle<P>& b, double z) {
  if (b.contact == Contact::hertz) return 1.5 * b.hertz_stiffness * std::sqrt(contact_depth(b, z));
  return contact_force(b, z).F_n * b.wall_rate;
}

}  // namespace bristle
