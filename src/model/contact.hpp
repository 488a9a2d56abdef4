#pragma once

#include <cmath>

namespace bristle {

// A short-range exponential repulsion: strength/(2 range) exp(-distance/range). Dimensionless force.
// Eq. (3) with distance z_0 - z, Eq. (4) with distance s.
template <class T, class P>
T short_range_force(const T& distance, const P& strength, const P& range) {
  using std::exp;
  const T exponent = -distance / range;
  return strength / (2 * range) * T(exp(exponent));
}

// The potential of short_range_force: -d/d(distance) of it is the force. Dimensionless energy.
template <class T, class P>
T short_range_energy(const T& distance, const P& strength, const P& range) {
  return range * short_range_force(distance, strength, range);
}

// The wall's force and its power 2/3, which Hertz needs, from one exponential.
template <class T>
struct WallForce {
  T F_n;
  T F_n_23;  // F_n^(2/3)
};

// Eq. (3) at the gap z_0 - z. cbrt_peak is (beta/(2 lambda_z))^(1/3).
template <class T, class P>
WallForce<T> wall_force(const T& gap, const P& cbrt_peak, const P& lambda_z) {
  using std::exp;
  const T exponent = -gap / (3 * lambda_z);
  const T root = cbrt_peak * T(exp(exponent));
  const T square = root * root;
  return {T(square * root), square};
}

}  // namespace bristle
