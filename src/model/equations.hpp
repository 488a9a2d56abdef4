#pragma once

#include "model/bristle.hpp"
#include "model/contact.hpp"
#include "model/friction/laws.hpp"

#include <array>

namespace bristle {

// (x, y, z), in units of r0 or V0.
template <class T>
using Vector3 = std::array<T, 3>;

// Tip position and velocity, azimuth theta (unwrapped) and polar angle phi (from the x-y plane), rad.
template <class T>
struct State {
  Vector3<T> r, v;
  T theta, phi;
};

// Lengths and unit vectors of Eq. (2) at a position away from the pole (s > 0): e_s = (cos_theta, sin_theta,
// 0), e_theta = (-sin_theta, cos_theta, 0), e_r = cos_phi e_s + sin_phi k, e_phi = -sin_phi e_s + cos_phi k.
template <class T>
struct Frame {
  T s, r, one_s, one_r;  // one_s = 1/s
  T cos_theta, sin_theta, cos_phi, sin_phi;
};

template <class T>
Frame<T> frame_at(const Vector3<T>& position) {
  const T &x = position[0], &y = position[1], &z = position[2];
  const T s2 = x * x + y * y, r2 = s2 + z * z;
  Frame<T> f;
  f.one_s = inverse_sqrt(s2);
  f.one_r = inverse_sqrt(r2);
  f.s = s2 * f.one_s;
  f.r = r2 * f.one_r;
  f.cos_theta = x * f.one_s;
  f.sin_theta = y * f.one_s;
  f.cos_phi = f.s * f.one_r;
  f.sin_phi = z * f.one_r;
  return f;
}

// theta', kinematically exact or by Eq. (17) as printed, and phi', Eq. (18).
template <class T>
struct AngularRates {
  T theta, phi;
};

template <class T>
AngularRates<T> angular_rates(AzimuthRate rule, const Frame<T>& f, const Vector3<T>& v) {
  const T along_s = f.cos_theta * v[0] + f.sin_theta * v[1];
  const T along_theta = f.cos_theta * v[1] - f.sin_theta * v[0];  // (x v_y - y v_x)/s
  const T along_phi = f.cos_phi * v[2] - f.sin_phi * along_s;     // r phi', equivalent to Eq. (18)
  const T theta_rate = rule == AzimuthRate::kinematic ? T(along_theta * f.one_s)
                                                      : T(along_theta * T(f.s * T(f.one_r * f.one_r)));
  return {theta_rate, T(along_phi * f.one_r)};
}

// Contact of the tip with the slab. V_R = 0 is a regular point: F_f/V_R keeps its finite limit.
template <class T>
struct SlabContact {
  T F_n, F_n_23;  // normal force, Eq. (3), and its power 2/3
  T V_R;          // relative speed
  T modulation;   // speed dependence of friction: chi, Eq. (7), for the paper's laws
  T F_f;          // friction force's magnitude, Eqs. (14, 15)
  T e_x, e_y;     // e_f = V_R/|V_R|, Eq. (6)
};

template <class T, class P>
SlabContact<T> slab_contact(const Bristle<P>& b, const State<T>& state) {
  const WallForce<T> wall = wall_force(T(b.z_0 - state.r[2]), b.wall_root_peak, b.wall_root_rate);
  const T V_x = state.v[0] - 1.0, V_y = state.v[1];
  // The offset vanishes in rounding for V_R > 1e-8 and gives the limit chi/V_R = A B/V_s at V_R = 0.
  const T V_R2 = V_x * V_x + V_y * V_y + 1e-32;
  const T one_V_R = inverse_sqrt(V_R2);
  const T V_R = V_R2 * one_V_R;
  return with_law(b.friction, [&](auto law) -> SlabContact<T> {
    const T modulation = law.modulation(V_R, b.friction_constants);
    const T F_f = T(b.friction_factor * modulation) * law.load(wall);
    return {wall.F_n, wall.F_n_23, V_R, modulation, F_f, T(V_x * one_V_R), T(V_y * one_V_R)};
  });
}

// Acceleration, angular rates and contact at one instant.
template <class T>
struct Motion {
  Vector3<T> acceleration;
  AngularRates<T> rates;
  SlabContact<T> slab;
};

// Eq. (13), resolved along e_s, e_theta and k, with Eqs. (17, 18).
template <class T, class P>
Motion<T> motion(const Bristle<P>& b, const State<T>& state) {
  Motion<T> m;
  const Frame<T> f = frame_at(state.r);
  m.rates = angular_rates(b.azimuth_rate, f, state.v);
  m.slab = slab_contact(b, state);
  const T radial = b.k_r * T(f.r - 1.0);
  const T azimuthal = T(b.k_theta * T(state.theta - b.theta_0) + b.c_theta * m.rates.theta) * f.one_s;
  const T polar = T(b.k_phi * T(state.phi - b.phi_0) + b.c_phi * m.rates.phi) * f.one_r;
  const T pole = short_range_force(f.s, b.pole_peak, b.pole_rate);
  const T along_s = pole - radial * f.cos_phi + polar * f.sin_phi;
  m.acceleration[0] = along_s * f.cos_theta + azimuthal * f.sin_theta - m.slab.F_f * m.slab.e_x;
  m.acceleration[1] = along_s * f.sin_theta - azimuthal * f.cos_theta - m.slab.F_f * m.slab.e_y;
  m.acceleration[2] = -radial * f.sin_phi - polar * f.cos_phi - m.slab.F_n;
  return m;
}

}  // namespace bristle
