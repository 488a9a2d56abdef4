#pragma once

#include "bristle/model/contact.hpp"
#include "bristle/model/friction/chi.hpp"

namespace bristle {

// Amontons-Coulomb: F_f = chi mu_c F_n, Eq. (14).
struct Coulomb : ModulatedByChi {
  static constexpr const char* name = "coulomb";
  static constexpr const char* title = "Coulomb friction";
  static constexpr double load_exponent = 1;
  static constexpr double Parameters::*strength = &Parameters::mu_c;
  static double factor(const Parameters& p) { return p.mu_c; }
  template <class T>
  static T load(const ContactForce<T>& contact) {
    return contact.F_n;
  }
  // Returns the friction force of rigid bristles under the load R_n, Eq. (23).
  static double rigid(const Parameters& p, double R_n) { return factor(p) * R_n; }
};

}  // namespace bristle
