#pragma once

#include "bristle/model/equations.hpp"

namespace bristle {

// Returns the potential energy of springs, contact and, in polar coordinates, pole repulsion. Dimensionless
// (m V0^2).
template <class T, class P>
T potential_energy(const Bristle<P>& b, const Vector3<T>& position, const T& theta, const T& phi) {
  const Frame<T> f = frame_at(position, has_pole(b.bending));
  const T stretch = f.r - 1.0;
  if (!has_pole(b.bending)) {
    const RodAngles<T> rod = rod_angles(b, position, f.one_r);
    return b.k_r * stretch * stretch / 2 + b.k_theta * rod.u_s * rod.u_s / 2 +
           b.k_phi * rod.u_p * rod.u_p / 2 + contact_energy(b, position[2]);
  }
  const T twist = theta - b.theta_0, bend = phi - b.phi_0;
  return b.k_r * stretch * stretch / 2 + b.k_theta * twist * twist / 2 + b.k_phi * bend * bend / 2 +
         contact_energy(b, position[2]) + short_range_energy(f.s, b.pole_peak, b.pole_rate);
}

// Returns the total energy E of the tip in contact. Dimensionless (m V0^2).
template <class T, class P>
T energy(const Bristle<P>& b, const State<T>& state) {
  return T((state.v[0] * state.v[0] + state.v[1] * state.v[1] + state.v[2] * state.v[2]) / 2) +
         potential_energy(b, state.r, state.theta, state.phi);
}

// Returns dE/dt from the forces: the power of the slab on the tip (F_fx V0) minus friction and damping
// losses. Equals the time derivative of energy() if conserves_energy(). Dimensionless.
template <class T, class P>
T power(const Bristle<P>& b, const Motion<T>& m) {
  const T friction = m.friction[0] * m.sliding.V_x + m.friction[1] * m.sliding.V_y;
  return m.friction[0] + friction - b.c_theta * m.rates.theta * m.rates.theta -
         b.c_phi * m.rates.phi * m.rates.phi;
}

}  // namespace bristle
