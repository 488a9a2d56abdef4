#pragma once

#include "bristle/model/bristle.hpp"
#include "bristle/model/elementary.hpp"

#include <array>
#include <cmath>

namespace bristle {

// The rod (docs/model.md): a spring against bending without a pole. n = r/|r| and the unit vectors d along
// the undeformed bristle, e_p = e_phi(theta_0, phi_0) and e_s = e_theta(theta_0) across it give the two
// bending angles u_p = g n.e_p and u_s = g n.e_s, where u_p^2 + u_s^2 is the square of the angle between n
// and d. Vectors in this file have components along d, e_p and e_s.

// The function g(c) = acos(c)/sqrt(1 - c^2) of the cosine c of an angle, and its derivative g'(c). g is
// singular only at c = -1, opposite to d.
template <class T>
struct AngleOverSine {
  T value, slope;
};

namespace rod {

// Coefficients of the polynomial in 1 - c that equals g at the 24 Chebyshev nodes of 0 <= 1 - c <= 1. With
// the coefficients as rounded here, the relative error in this range is below 1e-16 for g and below 1e-15 for
// its derivative.
constexpr std::array kPolynomial = {1.0,
                                    0.3333333333333335,
                                    0.13333333333330513,
                                    0.05714285714499993,
                                    0.025396825310535744,
                                    0.011544013675423239,
                                    0.005327970080234008,
                                    0.0024868159073461495,
                                    0.0011664917099132952,
                                    0.0005778044178899122,
                                    0.00014358403701863258,
                                    0.0006107247864522731,
                                    -0.0014936300890953343,
                                    0.004029832910424122,
                                    -0.008278968205055692,
                                    0.013853605165441644,
                                    -0.018555018218110963,
                                    0.019812667901296665,
                                    -0.016619375390181164,
                                    0.010725062370190754,
                                    -0.005142525502431651,
                                    0.0017291072948732483,
                                    -0.00036477640279838913,
                                    3.659122389158953e-05};
constexpr auto kDerivative = [] {
  std::array<double, kPolynomial.size() - 1> a{};
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = double(i + 1) * kPolynomial[i + 1];
  return a;
}();

// Returns the sum of a_i x^i by Estrin's scheme, in which most operations do not depend on each other, so
// that the processor overlaps them.
template <std::size_t N, class T>
T polynomial(const std::array<double, N>& a, T x) {
  std::array<T, (N + 1) / 2> sums;
  for (std::size_t i = 0; i < sums.size(); ++i)
    sums[i] = 2 * i + 1 < N ? T(a[2 * i + 1] * x + a[2 * i]) : T(a[2 * i]);
  for (std::size_t count = sums.size(); count > 1; count = (count + 1) / 2) {
    x = x * x;
    for (std::size_t i = 0; i < count / 2; ++i) sums[i] = sums[2 * i + 1] * x + sums[2 * i];
    if (count % 2 == 1) sums[count / 2] = sums[count - 1];
  }
  return sums[0];
}

}  // namespace rod

// Returns g and g' at c = 1 - versed. Values for angles beyond 90 degrees follow from angles below: acos(c) =
// pi - acos(-c).
template <class T>
AngleOverSine<T> angle_over_sine(T versed) {
  const T other = 2.0 - versed;  // 1 + c
  const auto beyond = T(1.0) < versed;
  const T x = select(beyond, other, versed);
  const T value = rod::polynomial(rod::kPolynomial, x), slope = rod::polynomial(rod::kDerivative, x);
  const T one_sine = inverse_sqrt(select(beyond, T(versed * other), T(1.0)));
  const T of_pi = M_PI * one_sine;
  return {select(beyond, T(of_pi - value), value),
          select(beyond, T(T(T(1.0 - versed) * of_pi) * T(one_sine * one_sine) - slope), T(-slope))};
}

// The bending angles (rad) and their gradients with respect to the tip's position, along x, y and z. The
// rates of the angles are the gradients times the velocity; the forces of bending are the moments times the
// gradients.
template <class T>
struct RodAngles {
  T u_p, u_s;
  Vector3<T> grad_p, grad_s;
};

template <class T>
T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Returns the bending angles at a position of the tip. one_r is the inverse of the tip's distance from the
// base.
template <class T, class P>
RodAngles<T> rod_angles(const Bristle<P>& b, const Vector3<T>& position, const T& one_r) {
  const T along_e_s = b.cos_theta_0 * position[0] + b.sin_theta_0 * position[1];
  const T across = b.cos_theta_0 * position[1] - b.sin_theta_0 * position[0];
  // Components of n = r/|r| along d, e_p and e_s; e_s = e_theta(theta_0) is horizontal.
  const T n_d = T(b.cos_phi_0 * along_e_s + b.sin_phi_0 * position[2]) * one_r;
  const T n_p = T(b.cos_phi_0 * position[2] - b.sin_phi_0 * along_e_s) * one_r;
  const T n_s = across * one_r;
  const auto [g, slope] = angle_over_sine(T(1.0 - n_d));
  // The gradient of u_p with respect to n is a_p = g e_p + g' n_p d. The gradient with respect to the
  // position is the part of a_p across n, divided by r.
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
