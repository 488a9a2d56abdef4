#pragma once

#include "bristle/model/parameters.hpp"
#include "bristle/model/elementary.hpp"

namespace bristle {

// Returns B of Eq. (7), chosen so that chi tends to 1 for V_R >> V_s. Requires A >= 1.
inline double chi_B(double A) { return 2 * (1 - asin(1 / A) / M_PI); }

// Returns C of Eq. (7) for which chi has its maximum at V_R = V_s, from B atan(1 - C (1 - pi/4)) = pi/2.
inline double chi_C_peak_at_V_s(double A) { return (1 - tan(M_PI / (2 * chi_B(A)))) / (1 - M_PI / 4); }

// Returns the velocity characteristic chi(u) of Eq. (7), u = V_R/V_s. Dimensionless.
template <class T, class P>
T chi(const T& u, const P& A, const P& B, const P& C) {
  const T stretched = u - C * T(u - T(atan(u)));
  const T angle = B * T(atan(stretched));
  return A * T(sin(angle));
}

// Base of the paper's two laws, which are modulated by chi. Constants: A, B, C.
struct ModulatedByChi {
  static FrictionConstants<double> constants(const Parameters& p) { return {{p.A, chi_B(p.A), p.C}}; }
  static double V_scale(const Parameters& p) { return p.V_s; }
  template <class T, class P>
  static T modulation(const T& u, const FrictionConstants<P>& c) {
    return chi(u, c[0], c[1], c[2]);
  }
};

}  // namespace bristle
