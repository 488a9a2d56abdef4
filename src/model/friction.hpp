#pragma once

#include "model/elementary.hpp"

namespace bristle {

// B of Eq. (7), so that chi tends to 1 for V_R >> V_s. Needs A >= 1.
inline double chi_B(double A) { return 2 * (1 - asin(1 / A) / M_PI); }

// The C of Eq. (7) that puts the maximum of chi at V_R = V_s: there B atan(1 - C (1 - pi/4)) = pi/2.
inline double chi_C_peak_at_V_s(double A) { return (1 - tan(M_PI / (2 * chi_B(A)))) / (1 - M_PI / 4); }

// Eq. (7): the velocity characteristic chi of u = V_R/V_s. Dimensionless.
template <class T, class P>
T chi(const T& u, const P& A, const P& B, const P& C) {
  const T stretched = u - C * T(u - T(atan(u)));
  const T angle = B * T(atan(stretched));
  return A * T(sin(angle));
}

// Contact area over F_n^(2/3), Eq. (16): A_c = area_factor F_n^(2/3). Dimensionless.
inline double hertz_area_factor(double R_c, double E_star) {
  const double c = cbrt(3 * R_c / (4 * E_star));
  return M_PI * c * c;
}

}  // namespace bristle
