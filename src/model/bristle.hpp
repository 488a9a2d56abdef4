#pragma once

#include "model/contact.hpp"
#include "model/friction/laws.hpp"
#include "model/parameters.hpp"

#include <Eigen/Core>
#include <cmath>

namespace bristle {

template <class T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

// The constants of one bristle under the slab, as the equations use them. P is the number type:
// double, or a vector of lanes with one bristle each. All dimensionless, angles in rad.
template <class P>
struct Bristle {
  FrictionLaw friction;
  AzimuthRate azimuth_rate;
  P k_r, k_theta, k_phi, c_theta, c_phi, theta_0, phi_0;
  FrictionConstants<P> friction_constants;  // of the law's modulation
  P friction_factor;                        // F_f over modulation and load
  P axis_peak, axis_rate;                   // of Eq. (4): alpha/(2 lambda), 1/lambda
  P wall_peak, wall_rate;                   // of Eq. (3): beta/(2 lambda_z), 1/lambda_z
  P wall_root_peak, wall_root_rate;
  P z_0;
};

// Calls visit with every constant, in a fixed order.
template <class B, class Visit>
void for_each_constant(B& b, Visit visit) {
  auto& friction = b.friction_constants;
  for (auto* constant :
       {&b.k_r, &b.k_theta, &b.k_phi, &b.c_theta, &b.c_phi, &b.theta_0, &b.phi_0, &friction[0], &friction[1],
        &friction[2], &friction[3], &b.friction_factor, &b.axis_peak, &b.axis_rate, &b.wall_peak,
        &b.wall_rate, &b.wall_root_peak, &b.wall_root_rate, &b.z_0})
    visit(*constant);
}
constexpr int kConstants = 19;  // that for_each_constant visits

// Eqs. (11, 12) and the derived constants of Eqs. (3, 7, 14-16), for the gap z_0 and the azimuth theta_0
// (rad).
inline Bristle<double> make_bristle(const Parameters& p, double z_0, double theta_0) {
  Bristle<double> b{};
  b.friction = p.friction;
  b.azimuth_rate = p.azimuth_rate;
  b.k_r = p.k_r;
  b.k_theta = p.k_theta;
  b.k_phi = p.k_phi;
  b.c_theta = 2 * p.zeta_theta * std::sqrt(p.k_theta) * cos(p.phi_0);
  b.c_phi = 2 * p.zeta_phi * std::sqrt(p.k_phi);
  b.theta_0 = theta_0;
  b.phi_0 = p.phi_0;
  with_law(p.friction, [&](auto law) {
    b.friction_constants = law.constants(p);
    b.friction_factor = law.factor(p);
  });
  b.axis_peak = p.alpha / (2 * p.lambda);
  b.axis_rate = 1 / p.lambda;
  b.wall_peak = p.beta / (2 * p.lambda_z);
  b.wall_rate = 1 / p.lambda_z;
  b.wall_root_peak = cbrt(b.wall_peak);
  b.wall_root_rate = b.wall_rate / 3;
  b.z_0 = z_0;
  return b;
}

// Tip position and velocity, azimuth (unwrapped) and polar angle (elevation).
template <class T>
struct State {
  Vector3<T> r, v;
  T theta, phi;
};

// Lengths and directions of Eq. (2) at a position off the axis (s > 0): e_s = (cos_theta, sin_theta, 0),
// e_theta = (-sin_theta, cos_theta, 0), e_r = cos_phi e_s + sin_phi k, e_phi = -sin_phi e_s + cos_phi k.
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

// theta': exact, or Eq. (17) as the paper prints it; and phi', Eq. (18).
template <class T>
struct AngularRates {
  T theta, phi;
};

template <class T>
AngularRates<T> angular_rates(AzimuthRate rule, const Frame<T>& f, const Vector3<T>& v) {
  const T along_s = f.cos_theta * v[0] + f.sin_theta * v[1];
  const T along_theta = f.cos_theta * v[1] - f.sin_theta * v[0];  // (x v_y - y v_x)/s
  const T along_phi = f.cos_phi * v[2] - f.sin_phi * along_s;     // r phi', the same as Eq. (18)
  const T theta_rate = rule == AzimuthRate::kinematic ? T(along_theta * f.one_s)
                                                      : T(along_theta * T(f.s * T(f.one_r * f.one_r)));
  return {theta_rate, T(along_phi * f.one_r)};
}

// What the slab does to the tip. V_R = 0 is an ordinary point: F_f/V_R keeps its finite limit.
template <class T>
struct SlabContact {
  T F_n, F_n_23;  // normal force, Eq. (3), and its power 2/3
  T V_R;          // relative speed
  T modulation;   // of friction by the speed: chi, Eq. (7), for the paper's laws
  T F_f;          // friction force's magnitude, Eqs. (14, 15)
  T e_x, e_y;     // e_f = V_R/|V_R|, Eq. (6)
};

template <class T, class P>
SlabContact<T> slab_contact(const Bristle<P>& b, const State<T>& state) {
  const WallForce<T> wall = wall_force(T(b.z_0 - state.r[2]), b.wall_root_peak, b.wall_root_rate);
  const T V_x = state.v[0] - 1.0, V_y = state.v[1];
  // The offset is below rounding for V_R > 1e-8 and gives V_R = 0 the limit chi/V_R = A B/V_s.
  const T V_R2 = V_x * V_x + V_y * V_y + 1e-32;
  const T one_V_R = inverse_sqrt(V_R2);
  const T V_R = V_R2 * one_V_R;
  return with_law(b.friction, [&](auto law) -> SlabContact<T> {
    const T modulation = law.modulation(V_R, b.friction_constants);
    const T F_f = T(b.friction_factor * modulation) * law.load(wall);
    return {wall.F_n, wall.F_n_23, V_R, modulation, F_f, T(V_x * one_V_R), T(V_y * one_V_R)};
  });
}

// Everything the integrators and diagnostics need at one instant.
template <class T>
struct Motion {
  Vector3<T> acceleration;
  AngularRates<T> rates;
  SlabContact<T> slab;
};

// Eq. (13), collected along e_s, e_theta and k, with the closing equations (17, 18).
template <class T, class P>
Motion<T> motion(const Bristle<P>& b, const State<T>& state) {
  Motion<T> m;
  const Frame<T> f = frame_at(state.r);
  m.rates = angular_rates(b.azimuth_rate, f, state.v);
  m.slab = slab_contact(b, state);
  const T radial = b.k_r * T(f.r - 1.0);
  const T azimuthal = T(b.k_theta * T(state.theta - b.theta_0) + b.c_theta * m.rates.theta) * f.one_s;
  const T polar = T(b.k_phi * T(state.phi - b.phi_0) + b.c_phi * m.rates.phi) * f.one_r;
  const T axis = short_range_force(f.s, b.axis_peak, b.axis_rate);
  const T along_s = axis - radial * f.cos_phi + polar * f.sin_phi;
  m.acceleration[0] = along_s * f.cos_theta + azimuthal * f.sin_theta - m.slab.F_f * m.slab.e_x;
  m.acceleration[1] = along_s * f.sin_theta - azimuthal * f.cos_theta - m.slab.F_f * m.slab.e_y;
  m.acceleration[2] = -radial * f.sin_phi - polar * f.cos_phi - m.slab.F_n;
  return m;
}

}  // namespace bristle
