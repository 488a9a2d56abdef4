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

// The bending angles (rad) and their gradients with respect to the tip's position, along x, y and z: rates
// are the gradients times the velocity, forces of bending the moments times the gradients.
template <class T>
struct RodAngles {
  T u_p, u_s;
  Vector3<T> grad_p, grad_s;
};

template <class T>
T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// one_r is the inverse of the tip's distance from the base.
template <class T, class P>
RodAngles<T> rod_angles(const Bristle<P>& b, const Vector3<T>& position, const T& one_r) {
  const T along_e_s = b.cos_theta_0 * position[0] + b.sin_theta_0 * position[1];
  const T across = b.cos_theta_0 * position[1] - b.sin_theta_0 * position[0];
  // n = r/|r| along d, e_p and e_s, of which e_s = e_theta(theta_0) is horizontal.
  const T n_d = T(b.cos_phi_0 * along_e_s + b.sin_phi_0 * position[2]) * one_r;
  const T n_p = T(b.cos_phi_0 * position[2] - b.sin_phi_0 * along_e_s) * one_r;
  const T n_s = across * one_r;
  const auto [g, slope] = angle_over_sine(T(1.0 - n_d));
  // The gradient with respect to n of u_p is a_p = g e_p + g' n_p d; of it the part across n, over r.
  const T g_r = g * one_r, slope_r = slope * one_r;
  const auto gradient = [&](const T& n_i, const T& e_p, const T& e_s) {
    const T along_n = n_i * T(slope_r * n_d + g_r);
    const T d = slope_r * n_i - along_n * n_d;
    const T p = g_r * e_p - along_n * n_p;
    const T s = g_r * e_s - along_n * n_s;
    const T along = b.cos_phi_0 * d - b.sin_phi_0 * p;
    return Vector3<T>{T(b.cos_theta_0 * along - b.sin_theta_0 * s),
                      T(b.sin_theta_0 * along + b.cos_theta_0 * s), T(b.sin_phi_0 * d + b.cos_phi_0 * p)};
  };
  return {T(g * n_p), T(g * n_s), gradient(n_p, T(1.0), T(0.0)), gradient(n_s, T(0.0), T(1.0))};
}

}  // namespace bristle
