#pragma once

#include "model/bristle.hpp"
#include "model/elementary.hpp"

namespace bristle {

// The rod (docs/model.md): a spring against bending without a pole. n = r/|r| and the unit vectors d along
// the undeformed bristle, e_p = e_phi(theta_0, phi_0) and e_s = e_theta(theta_0) across it give the two
// bending angles u_p = g n.e_p and u_s = g n.e_s, where u_p^2 + u_s^2 is the square of the angle between n
// and d. Vectors of this file have the components along d, e_p, e_s.

// g(c) = acos(c)/sqrt(1 - c^2) for the cosine c of an angle, and its derivative g'(c). It is singular only at
// c = -1, opposite to d.
template <class T>
struct AngleOverSine {
  T value, slope;
};

namespace rod {

// The series of acos(c)/sqrt(1 - c^2) in (1 - c)/2: coefficients 4^i (i!)^2/(2 i + 1)!.
constexpr int kTerms = 11;
constexpr auto kSeries = [] {
  std::array<double, kTerms> a{1};
  for (int i = 1; i < kTerms; ++i) a[i] = a[i - 1] * (2. * i / (2. * i + 1));
  return a;
}();

}  // namespace rod

// With c_i = cos(angle/2^i), g(c_0) = g(c_1)/c_1: three times halved, an angle is at most 22.5 degrees, where
// the series is exact to rounding. versed = 1 - c, which halves without cancellation.
template <class T>
AngleOverSine<T> angle_over_sine(T versed) {
  constexpr int halvings = 3;
  std::array<T, halvings> one_cosine;  // 1/c_i
  for (T& one_c : one_cosine) {
    const T square = 1.0 - 0.5 * versed;  // c_i^2
    one_c = inverse_sqrt(square);
    versed = T(0.5 * versed) * T(one_c / T(1.0 + one_c));  // 1 - c_i = (1 - c_i^2)/(1 + c_i)
  }
  const T x = 0.5 * versed;
  T value = rod::kSeries[rod::kTerms - 1], slope = 0.0;
  for (int i = rod::kTerms - 2; i >= 0; --i) {
    slope = slope * x + value;
    value = value * x + rod::kSeries[i];
  }
  slope = -0.5 * slope;                      // dx/dc = -1/2
  for (int i = halvings - 1; i >= 0; --i) {  // dc_i/dc_(i-1) = 1/(4 c_i)
    const T& one_c = one_cosine[i];
    value = value * one_c;
    slope = T(slope - value) * T(0.25 * T(one_c * one_c));
  }
  return {value, slope};
}

// The components along d, e_p and e_s of a vector (x, y, z), and back.
template <class T, class P>
Vector3<T> in_rod_axes(const Bristle<P>& b, const Vector3<T>& xyz) {
  const T along_s = b.cos_theta_0 * xyz[0] + b.sin_theta_0 * xyz[1];
  const T along_theta = b.cos_theta_0 * xyz[1] - b.sin_theta_0 * xyz[0];
  return {T(b.cos_phi_0 * along_s + b.sin_phi_0 * xyz[2]), T(b.cos_phi_0 * xyz[2] - b.sin_phi_0 * along_s),
          along_theta};
}
template <class T, class P>
Vector3<T> from_rod_axes(const Bristle<P>& b, const Vector3<T>& v) {
  const T along_s = b.cos_phi_0 * v[0] - b.sin_phi_0 * v[1];
  return {T(b.cos_theta_0 * along_s - b.sin_theta_0 * v[2]),
          T(b.sin_theta_0 * along_s + b.cos_theta_0 * v[2]), T(b.sin_phi_0 * v[0] + b.cos_phi_0 * v[1])};
}

template <class T>
T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Bending angles in rad and their rates, with the force on the tip.
template <class T>
struct RodBending {
  T u_p, u_s;
  T u_p_rate, u_s_rate;
  Vector3<T> force;  // along x, y, z
};

// Angles, rates and force of bending at a position with the distance r = 1/one_r from the base.
template <class T, class P>
RodBending<T> rod_bending(const Bristle<P>& b, const Vector3<T>& position, const T& one_r,
                          const Vector3<T>& velocity) {
  Vector3<T> n = in_rod_axes(b, position), rate = in_rod_axes(b, velocity);
  for (T& component : n) component = component * one_r;
  const T v_r = dot(rate, n);
  for (int i = 0; i < 3; ++i) rate[i] = T(rate[i] - v_r * n[i]) * one_r;  // n' = (v - (v.n) n)/r
  const auto [g, slope] = angle_over_sine(T(1.0 - n[0]));
  RodBending<T> out;
  out.u_p = g * n[1];
  out.u_s = g * n[2];
  // The gradients with respect to n: a_p = g e_p + g' (n.e_p) d, and a_s likewise.
  const T stretch = slope * rate[0];
  out.u_p_rate = g * rate[1] + stretch * n[1];
  out.u_s_rate = g * rate[2] + stretch * n[2];
  const T moment_p = b.k_phi * out.u_p + b.c_phi * out.u_p_rate;
  const T moment_s = b.k_theta * out.u_s + b.c_theta * out.u_s_rate;
  const Vector3<T> gradient = {T(slope * T(n[1] * moment_p + n[2] * moment_s)), T(g * moment_p),
                               T(g * moment_s)};
  const T along_n = dot(gradient, n);
  Vector3<T> across;
  for (int i = 0; i < 3; ++i) across[i] = T(along_n * n[i] - gradient[i]) * one_r;
  out.force = from_rod_axes(b, across);
  return out;
}

}  // namespace bristle
