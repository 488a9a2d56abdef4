#pragma once

#include "model/contact.hpp"
#include "model/friction/laws.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace bristle {

// Constants of one bristle under the slab, precomputed for the equations. P is the number type: double, or a
// SIMD vector with one bristle per lane. Dimensionless, angles in rad.
template <class P>
struct Bristle {
  FrictionLaw friction;
  AzimuthRate azimuth_rate;
  P k_r, k_theta, k_phi, c_theta, c_phi, theta_0, phi_0;
  FrictionConstants<P> friction_constants;
  P friction_factor;                 // Eqs. (14-16): F_f = friction_factor * modulation(V_R) * load(F_n)
  P pole_peak, pole_rate;            // Eq. (4): alpha/(2 lambda), 1/lambda
  P wall_peak, wall_rate;            // Eq. (3): beta/(2 lambda_z), 1/lambda_z
  P wall_root_peak, wall_root_rate;  // cube root of wall_peak, wall_rate/3
  P z_0;
};

// Pointers to all numbers of a Bristle, in a fixed order.
// The SIMD engine uses them to copy a bristle into a lane.
template <class B>
constexpr auto constants_of(B& b) {
  auto& friction = b.friction_constants;
  return std::array{&b.k_r,       &b.k_theta,         &b.k_phi,          &b.c_theta,   &b.c_phi,
                    &b.theta_0,   &b.phi_0,           &friction[0],      &friction[1], &friction[2],
                    &friction[3], &b.friction_factor, &b.pole_peak,      &b.pole_rate, &b.wall_peak,
                    &b.wall_rate, &b.wall_root_peak,  &b.wall_root_rate, &b.z_0};
}
constexpr std::size_t kConstants =
    std::tuple_size_v<decltype(constants_of(std::declval<Bristle<double>&>()))>;
static_assert(sizeof(Bristle<double>) ==
                  sizeof(FrictionLaw) + sizeof(AzimuthRate) + kConstants * sizeof(double),
              "constants_of() must list every number of Bristle");

// Evaluates Eqs. (11, 12) and the derived constants of Eqs. (3, 4, 7, 14-16) for the gap z_0 (dimensionless)
// and the undeformed azimuth theta_0 (rad).
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
  b.pole_peak = p.alpha / (2 * p.lambda);
  b.pole_rate = 1 / p.lambda;
  b.wall_peak = p.beta / (2 * p.lambda_z);
  b.wall_rate = 1 / p.lambda_z;
  b.wall_root_peak = cbrt(b.wall_peak);
  b.wall_root_rate = b.wall_rate / 3;
  b.z_0 = z_0;
  return b;
}

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

// theta' per velocity along e_theta: 1/s, kinematically exact, or s/r^2 by Eq. (17) as printed.
template <class T>
T azimuth_rate_factor(AzimuthRate rule, const Frame<T>& f) {
  return rule == AzimuthRate::kinematic ? f.one_s : T(f.s * T(f.one_r * f.one_r));
}

// theta', Eq. (17), and phi', Eq. (18).
template <class T>
struct AngularRates {
  T theta, phi;
};

template <class T>
AngularRates<T> angular_rates(AzimuthRate rule, const Frame<T>& f, const Vector3<T>& v) {
  const T along_s = f.cos_theta * v[0] + f.sin_theta * v[1];
  const T along_theta = f.cos_theta * v[1] - f.sin_theta * v[0];  // (x v_y - y v_x)/s
  const T along_phi = f.cos_phi * v[2] - f.sin_phi * along_s;     // r phi', equivalent to Eq. (18)
  return {T(along_theta * azimuth_rate_factor(rule, f)), T(along_phi * f.one_r)};
}

// What the equations need of the tip's position.
template <class T>
struct Place {
  Frame<T> frame;
  WallForce<T> wall;  // normal force, Eq. (3), and its power 2/3
  T friction_limit;   // friction force where the modulation is 1, Eqs. (14, 15)
};

template <class T, class P>
Place<T> place_at(const Bristle<P>& b, const Vector3<T>& position) {
  const WallForce<T> wall = wall_force(T(b.z_0 - position[2]), b.wall_root_peak, b.wall_root_rate);
  const T load = with_law(b.friction, [&](auto law) -> T { return law.load(wall); });
  return {frame_at(position), wall, T(b.friction_factor * load)};
}

// Motion of the tip relative to the slab. V_R = 0 is a regular point: modulation/V_R keeps its finite limit.
template <class T>
struct Sliding {
  T V_x, V_y, V_R;  // relative velocity and speed
  T e_x, e_y;       // e_f = V_R/|V_R|, Eq. (6)
  T modulation;     // speed dependence of friction: chi, Eq. (7), for the paper's laws
};

// All but the modulation.
template <class T>
Sliding<T> relative_motion(const T& v_x, const T& v_y) {
  Sliding<T> s;
  s.V_x = v_x - 1.0;
  s.V_y = v_y;
  // The offset vanishes in rounding for V_R > 1e-8.
  const T V_R2 = s.V_x * s.V_x + s.V_y * s.V_y + 1e-32;
  const T one_V_R = inverse_sqrt(V_R2);
  s.V_R = V_R2 * one_V_R;
  s.e_x = s.V_x * one_V_R;
  s.e_y = s.V_y * one_V_R;
  return s;
}

template <class T, class P>
Sliding<T> sliding_at(const Bristle<P>& b, const T& v_x, const T& v_y) {
  Sliding<T> s = relative_motion(v_x, v_y);
  s.modulation =
      with_law(b.friction, [&](auto law) -> T { return law.modulation(s.V_R, b.friction_constants); });
  return s;
}

// Friction force on the tip, in the plane of the slab.
template <class T>
using InPlane = std::array<T, 2>;

template <class T>
InPlane<T> friction_force(const Place<T>& place, const Sliding<T>& sliding) {
  const T F_f = place.friction_limit * sliding.modulation;
  return {T(-F_f * sliding.e_x), T(-F_f * sliding.e_y)};
}

// Acceleration, angular rates and contact at one instant.
template <class T>
struct Motion {
  Vector3<T> acceleration;
  AngularRates<T> rates;
  WallForce<T> wall;
  Sliding<T> sliding;
  InPlane<T> friction;
};

// Eq. (13), resolved along e_s, e_theta and k, with Eqs. (17, 18), for a given friction force.
template <class T, class P>
Motion<T> motion(const Bristle<P>& b, const State<T>& state, const Place<T>& place, const Sliding<T>& sliding,
                 const InPlane<T>& friction) {
  const Frame<T>& f = place.frame;
  Motion<T> m{{}, angular_rates(b.azimuth_rate, f, state.v), place.wall, sliding, friction};
  const T radial = b.k_r * T(f.r - 1.0);
  const T azimuthal = T(b.k_theta * T(state.theta - b.theta_0) + b.c_theta * m.rates.theta) * f.one_s;
  const T polar = T(b.k_phi * T(state.phi - b.phi_0) + b.c_phi * m.rates.phi) * f.one_r;
  const T pole = short_range_force(f.s, b.pole_peak, b.pole_rate);
  const T along_s = pole - radial * f.cos_phi + polar * f.sin_phi;
  m.acceleration[0] = along_s * f.cos_theta + azimuthal * f.sin_theta + friction[0];
  m.acceleration[1] = along_s * f.sin_theta - azimuthal * f.cos_theta + friction[1];
  m.acceleration[2] = -radial * f.sin_phi - polar * f.cos_phi - place.wall.F_n;
  return m;
}

template <class T, class P>
Motion<T> motion(const Bristle<P>& b, const State<T>& state) {
  const Place<T> place = place_at(b, state.r);
  const Sliding<T> sliding = sliding_at(b, state.v[0], state.v[1]);
  return motion(b, state, place, sliding, friction_force(place, sliding));
}

// The azimuth's damper exerts the force -azimuth_damping() v_theta along e_theta, that of the polar angle
// -polar_damping() v_phi along e_phi.
template <class T, class P>
T azimuth_damping(const Bristle<P>& b, const Frame<T>& f) {
  return b.c_theta * T(azimuth_rate_factor(b.azimuth_rate, f) * f.one_s);
}
template <class T, class P>
T polar_damping(const Bristle<P>& b, const Frame<T>& f) {
  return b.c_phi * T(f.one_r * f.one_r);
}

}  // namespace bristle
