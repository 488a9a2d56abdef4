#pragma once

#include "bristle/model/contact.hpp"
#include "bristle/model/friction/chi.hpp"

namespace bristle {

// Returns the factor of the contact area A_c = hertz_area_factor F_n^(2/3), Eq. (16). Dimensionless.
inline double hertz_area_factor(double R_c, double E_star) {
  const double c = cbrt(3 * R_c / (4 * E_star));
  return M_PI * c * c;
}

// Returns the largest pressure in the contact of a tip under the force F_n by Hertz: 3/2 of the mean
// pressure, F_n over the area. Dimensionless.
inline double hertz_pressure(const Parameters& p, double F_n) {
  return 1.5 * cbrt(F_n) / hertz_area_factor(p.R_c, p.E_star);
}

// Nominal shear stress: F_f = chi tau_f A_c, Eqs. (15, 16).
struct Nss : ModulatedByChi {
  static constexpr const char* name = "nss";
  static constexpr const char* title = "nominal shear stress (NSS)";
  static constexpr double load_exponent = 2.0 / 3;
  static constexpr double Parameters::*strength = &Parameters::tau_f;
  static double factor(const Parameters& p) { return p.tau_f * hertz_area_factor(p.R_c, p.E_star); }
  template <class T>
  static T load(const ContactForce<T>& contact) {
    return contact.F_n_23;
  }
  // Returns the friction force of rigid bristles under the load R_n, Eq. (22).
  static double rigid(const Parameters& p, double R_n) {
    const double root = cbrt(R_n);
    return factor(p) * root * root;
  }
};

}  // namespace bristle
