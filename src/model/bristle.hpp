#pragma once

#include "model/contact.hpp"
#include "model/friction.hpp"
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
  P A, B, C, inverse_V_s;
  P friction_factor;  // mu_c (Coulomb) or tau_f times the Hertz area at F_n = 1 (NSS)
  P alpha, lambda, beta, lambda_z, cbrt_wall_peak, z_0;
};

// Eqs. (11, 12) and the derived constants of Eqs. (3, 7, 14-16), for the gap z_0 and the azimuth theta_0
// (rad).
inline Bristle<double> make_bristle(const Parameters& p, double z_0, double theta_0) {
  Bristle<double> b{};
  b.friction = p.friction;
  b.azimuth_rate = p.azimuth_rate;
  b.k_r = p.k_r;
  b.k_theta = p.k_theta;
  b.k_phi = p.k_phi;
  b.c_theta = 2 * p.zeta_theta * std::sqrt(p.k_theta) * std::cos(p.phi_0);
  b.c_phi = 2 * p.zeta_phi * std::sqrt(p.k_phi);
  b.theta_0 = theta_0;
  b.phi_0 = p.phi_0;
  b.A = p.A;
  b.B = chi_B(p.A);
  b.C = p.C;
  b.inverse_V_s = 1 / p.V_s;
  b.friction_factor = p.friction == FrictionLaw::nss ? p.tau_f * hertz_area_factor(p.R_c, p.E_star) : p.mu_c;
  b.alpha = p.alpha;
  b.lambda = p.lambda;
  b.beta = p.beta;
  b.lambda_z = p.lambda_z;
  b.cbrt_wall_peak = std::cbrt(p.beta / (2 * p.lambda_z));
  b.z_0 = z_0;
  return b;
}

// Tip position and velocity, azimuth (unwrapped) and polar angle (elevation).
template <class T>
struct State {
  Vector3<T> r, v;
  T theta, phi;
};

// Lengths and unit vectors of Eq. (2) at a position off the axis (s > 0).
template <class T>
struct Frame {
  T s, r;
  Vector3<T> e_r, e_theta, e_phi, e_s;
};

template <class T>
Frame<T> frame_at(const Vector3<T>& position) {
  using std::sqrt;
  const T &x = position[0], &y = position[1], &z = position[2];
  const T zero = T(x - x);
  const T s2 = x * x + y * y;
  Frame<T> f;
  f.s = T(sqrt(s2));
  f.r = T(sqrt(T(s2 + z * z)));
  const T one_s = 1.0 / f.s;
  const T one_r = 1.0 / f.r;
  const T cos_theta = x * one_s, sin_theta = y * one_s;
  const T sin_phi = z * one_r, cos_phi = f.s * one_r;
  f.e_r << T(x * one_r), T(y * one_r), sin_phi;
  f.e_theta << T(-sin_theta), cos_theta, zero;
  f.e_phi << T(-cos_theta * sin_phi), T(-sin_theta * sin_phi), cos_phi;
  f.e_s << cos_theta, sin_theta, zero;
  return f;
}

// theta': exact, or Eq. (17) as the paper prints it; and phi', Eq. (18).
template <class T>
struct AngularRates {
  T theta, phi;
};

template <class T>
AngularRates<T> angular_rates(AzimuthRate rule, const Frame<T>& f, const Vector3<T>& v) {
  const T tangential = f.e_theta.dot(v);  // (x v_y - y v_x)/s
  const T polar = f.e_phi.dot(v);         // r phi', the same as Eq. (18)
  const T theta_rate =
      rule == AzimuthRate::kinematic ? T(tangential / f.s) : T(tangential * f.s / (f.r * f.r));
  return {theta_rate, T(polar / f.r)};
}

// What the slab does to the tip. V_R = 0 is an ordinary point: F_f/V_R keeps its finite limit.
template <class T>
struct SlabContact {
  T F_n, F_n_23;    // normal force, Eq. (3), and its power 2/3
  T V_R, chi, F_f;  // relative speed, Eq. (7), friction force's magnitude, Eqs. (14, 15)
  T e_x, e_y;       // e_f = V_R/|V_R|, Eq. (6)
};

template <class T, class P>
SlabContact<T> slab_contact(const Bristle<P>& b, const State<T>& state) {
  using std::sqrt;
  const WallForce<T> wall = wall_force(T(b.z_0 - state.r[2]), b.cbrt_wall_peak, b.lambda_z);
  const T V_x = state.v[0] - 1.0, V_y = state.v[1];
  // The offset is below rounding for V_R > 1e-8 and gives V_R = 0 the limit chi/V_R = A B/V_s.
  const T V_R = T(sqrt(T(V_x * V_x + V_y * V_y + 1e-32)));
  const T chi_V = chi(T(V_R * b.inverse_V_s), b.A, b.B, b.C);
  const T load = b.friction == FrictionLaw::nss ? wall.F_n_23 : wall.F_n;
  return {wall.F_n, wall.F_n_23, V_R, chi_V, T(b.friction_factor * chi_V * load), T(V_x / V_R), T(V_y / V_R)};
}

// Everything the integrators and diagnostics need at one instant.
template <class T>
struct Motion {
  Vector3<T> acceleration;
  AngularRates<T> rates;
  SlabContact<T> slab;
};

// Eq. (13) with the closing equations (17, 18).
template <class T, class P>
Motion<T> motion(const Bristle<P>& b, const State<T>& state) {
  Motion<T> m;
  const Frame<T> f = frame_at(state.r);
  m.rates = angular_rates(b.azimuth_rate, f, state.v);
  m.slab = slab_contact(b, state);
  const T radial = b.k_r * T(f.r - 1.0);
  const T azimuthal = (b.k_theta * T(state.theta - b.theta_0) + b.c_theta * m.rates.theta) / f.s;
  const T polar = (b.k_phi * T(state.phi - b.phi_0) + b.c_phi * m.rates.phi) / f.r;
  const T axis = short_range_force(f.s, b.alpha, b.lambda);
  for (int i = 0; i < 3; ++i)
    m.acceleration[i] = axis * f.e_s[i] - radial * f.e_r[i] - azimuthal * f.e_theta[i] - polar * f.e_phi[i];
  m.acceleration[0] -= m.slab.F_f * m.slab.e_x;
  m.acceleration[1] -= m.slab.F_f * m.slab.e_y;
  m.acceleration[2] -= m.slab.F_n;
  return m;
}

}  // namespace bristle
