#pragma once

#include "bristle/model/bristle.hpp"
#include "bristle/model/contact.hpp"
#include "bristle/model/rod.hpp"

namespace bristle {

// The argument pole of the functions below is has_pole() of the bristle: a bool, or a constant such as
// std::true_type, with which the compiler leaves out the other kind of bending.

// Lengths and unit vectors of Eq. (2) at a position: e_s = (cos_theta, sin_theta, 0), e_theta = (-sin_theta,
// cos_theta, 0), e_r = cos_phi e_s + sin_phi k, e_phi = -sin_phi e_s + cos_phi k. Members that are singular
// at the pole, s = 0, have values only for bristles with a pole.
template <class T>
struct Frame {
  T r, one_r;  // one_r = 1/r
  T s, one_s;
  T cos_theta, sin_theta, cos_phi, sin_phi;
};

template <class T, class Pole>
Frame<T> frame_at(const Vector3<T>& position, Pole pole) {
  const T &x = position[0], &y = position[1], &z = position[2];
  const T s2 = x * x + y * y, r2 = s2 + z * z;
  Frame<T> f;
  f.one_r = inverse_sqrt(r2);
  f.r = r2 * f.one_r;
  if (!pole) return f;
  f.one_s = inverse_sqrt(s2);
  f.s = s2 * f.one_s;
  f.cos_theta = x * f.one_s;
  f.sin_theta = y * f.one_s;
  f.cos_phi = f.s * f.one_r;
  f.sin_phi = z * f.one_r;
  return f;
}

// Returns theta' over the velocity along e_theta: 1/s, kinematically exact, or s/r^2 by Eq. (17) as printed.
template <class T>
T azimuth_rate_factor(Bending bending, const Frame<T>& f) {
  return bending == Bending::polar ? f.one_s : T(f.s * T(f.one_r * f.one_r));
}

// The rates theta', Eq. (17), and phi', Eq. (18); for a rod, the rates of the bending angles u_s and u_p.
template <class T>
struct AngularRates {
  T theta, phi;
};

template <class T>
AngularRates<T> angular_rates(Bending bending, const Frame<T>& f, const Vector3<T>& v) {
  const T along_s = f.cos_theta * v[0] + f.sin_theta * v[1];
  const T along_theta = f.cos_theta * v[1] - f.sin_theta * v[0];  // (x v_y - y v_x)/s
  const T along_phi = f.cos_phi * v[2] - f.sin_phi * along_s;     // r phi', equivalent to Eq. (18)
  return {T(along_theta * azimuth_rate_factor(bending, f)), T(along_phi * f.one_r)};
}

// What the equations need to know about the tip's position.
template <class T>
struct Place {
  Frame<T> frame;
  RodAngles<T> rod;  // set for rods only
  ContactForce<T> contact;
  T friction_limit;  // friction_limit()
};

// Returns the friction force where the modulation is 1, Eqs. (14, 15).
template <class T, class P>
T friction_limit(const Bristle<P>& b, const ContactForce<T>& contact) {
  return b.friction_factor * with_law(b.friction, [&](auto law) -> T { return law.load(contact); });
}

template <class T, class P, class Pole>
Place<T> place_at(const Bristle<P>& b, const Vector3<T>& position, Pole pole) {
  Place<T> place;
  place.frame = frame_at(position, pole);
  if (!pole) place.rod = rod_angles(b, position, place.frame.one_r);
  place.contact = contact_force(b, position[2]);
  place.friction_limit = friction_limit(b, place.contact);
  return place;
}

// Motion of the tip relative to the slab. V_R = 0 is a regular point: modulation/V_R keeps its finite limit.
template <class T>
struct Sliding {
  T V_x, V_y, V_R;  // relative velocity and speed
  T e_x, e_y;       // e_f = V_R/|V_R|, Eq. (6)
  T modulation;     // speed dependence of friction: chi, Eq. (7), for the paper's laws
};

// Returns the motion of the tip relative to the slab, without the modulation. v_x and v_y are the tip's
// velocity.
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
  s.modulation = with_law(
      b.friction, [&](auto law) -> T { return law.modulation(T(s.V_R / b.V_scale), b.friction_constants); });
  return s;
}

// Components x and y of a force in the plane of the slab.
template <class T>
using InPlane = std::array<T, 2>;

// Returns the friction force on the tip; limit is friction_limit().
template <class T>
InPlane<T> friction_force(const T& limit, const Sliding<T>& sliding) {
  const T F_f = limit * sliding.modulation;
  return {T(-F_f * sliding.e_x), T(-F_f * sliding.e_y)};
}

// Acceleration, angular rates and contact at one instant.
template <class T>
struct Motion {
  Vector3<T> acceleration;
  AngularRates<T> rates;
  ContactForce<T> contact;
  Sliding<T> sliding;
  InPlane<T> friction;
};

// Sets the acceleration, Eq. (13) resolved along e_s, e_theta and k, and the rates, Eqs. (17, 18).
template <class T, class P>
void set_polar_motion(const Bristle<P>& b, const State<T>& state, const Frame<T>& f, Motion<T>& m) {
  m.rates = angular_rates(b.bending, f, state.v);
  const T radial = b.k_r * T(f.r - 1.0);
  const T azimuthal = T(b.k_theta * T(state.theta - b.theta_0) + b.c_theta * m.rates.theta) * f.one_s;
  const T polar = T(b.k_phi * T(state.phi - b.phi_0) + b.c_phi * m.rates.phi) * f.one_r;
  const T pole = short_range_force(f.s, b.pole_peak, b.pole_rate);
  const T along_s = pole - radial * f.cos_phi + polar * f.sin_phi;
  m.acceleration[0] = along_s * f.cos_theta + azimuthal * f.sin_theta + m.friction[0];
  m.acceleration[1] = along_s * f.sin_theta - azimuthal * f.cos_theta + m.friction[1];
  m.acceleration[2] = -radial * f.sin_phi - polar * f.cos_phi - m.contact.F_n;
}

// Sets the acceleration of a rod and the rates of its bending angles.
template <class T, class P>
void set_rod_motion(const Bristle<P>& b, const State<T>& state, const Place<T>& place, Motion<T>& m) {
  const RodAngles<T>& rod = place.rod;
  m.rates = {dot(rod.grad_s, state.v), dot(rod.grad_p, state.v)};
  const T moment_p = b.k_phi * rod.u_p + b.c_phi * m.rates.phi;
  const T moment_s = b.k_theta * rod.u_s + b.c_theta * m.rates.theta;
  const T radial = b.k_r * T(T(place.frame.r - 1.0) * place.frame.one_r);  // per position
  const auto springs = [&](int i) -> T {
    return -radial * state.r[i] - moment_p * rod.grad_p[i] - moment_s * rod.grad_s[i];
  };
  m.acceleration = {T(springs(0) + m.friction[0]), T(springs(1) + m.friction[1]),
                    T(springs(2) - m.contact.F_n)};
}

// Returns the motion by Eq. (13) with Eqs. (17, 18), for a given friction force.
template <class T, class P, class Pole>
Motion<T> motion(const Bristle<P>& b, const State<T>& state, const Place<T>& place, const Sliding<T>& sliding,
                 const InPlane<T>& friction, Pole pole) {
  Motion<T> m{{}, {}, place.contact, sliding, friction};
  if (pole) set_polar_motion(b, state, place.frame, m);
  else set_rod_motion(b, state, place, m);
  return m;
}

template <class T, class P>
Motion<T> motion(const Bristle<P>& b, const State<T>& state) {
  const bool pole = has_pole(b.bending);
  const Place<T> place = place_at(b, state.r, pole);
  const Sliding<T> sliding = sliding_at(b, state.v[0], state.v[1]);
  return motion(b, state, place, sliding, friction_force(place.friction_limit, sliding), pole);
}

// Returns the damping coefficient of the velocity along e_theta: the damper of the azimuth exerts the force
// -azimuth_damping() v_theta along e_theta.
template <class T, class P>
T azimuth_damping(const Bristle<P>& b, const Frame<T>& f) {
  return b.c_theta * T(azimuth_rate_factor(b.bending, f) * f.one_s);
}
// Returns the damping coefficient of the velocity along e_phi: the damper of the polar angle exerts the force
// -polar_damping() v_phi along e_phi.
template <class T, class P>
T polar_damping(const Bristle<P>& b, const Frame<T>& f) {
  return b.c_phi * T(f.one_r * f.one_r);
}

}  // namespace bristle
