#pragma once

#include "model/elementary.hpp"

namespace bristle {

// Short-range exponential repulsion, Eqs. (3, 4): strength/(2 range) exp(-distance/range). Dimensionless
// force. peak is strength/(2 range), rate is 1/range.
template <class T, class P>
T short_range_force(const T& distance, const P& peak, const P& rate) {
  const T exponent = -distance * rate;
  return peak * T(decay(exponent));
}

// Potential of short_range_force(): its negative derivative
// by the distance is the force. Dimensionless energy.
template <class T, class P>
T short_range_energy(const T& distance, const P& peak, const P& rate) {
  return short_range_force(distance, peak, rate) / rate;
}

// Normal force of the slab's wall and its power 2/3 (for
// the Hertzian contact area). One exponential gives both.
template <class T>
struct WallForce {
  T F_n;
  T F_n_23;  // F_n^(2/3)
};

// Eq. (3) at the distance z_0 - z. root_peak is the cube root of the peak, root_rate a third of the rate.
template <class T, class P>
WallForce<T> wall_force(const T& distance, const P& root_peak, const P& root_rate) {
  const T exponent = -distance * root_rate;
  const T root = root_peak * T(decay(exponent));
  const T square = root * root;
  return {T(square * root), square};
}

}  // namespace bristle
