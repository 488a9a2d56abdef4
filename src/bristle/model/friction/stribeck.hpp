#pragma once

#include "bristle/model/contact.hpp"
#include "bristle/model/friction/chi.hpp"

namespace bristle {

// Exponential Stribeck law: F_f = mu_c [1 + (A - 1) exp(-(V_R/V_s)^2)] F_n. A is
// the ratio of static to kinetic friction, V_s the Stribeck speed. Below the creep
// speed V_s/5 friction is proportional to V_R, so that V_R = 0 is a regular point.
struct Stribeck {
  static constexpr const char* name = "stribeck";
  static constexpr const char* title = "exponential Stribeck";
  static constexpr double load_exponent = 1;
  static constexpr double Parameters::*strength = &Parameters::mu_c;
  // Returns the constants A - 1 and V_s/(creep speed).
  static FrictionConstants<double> constants(const Parameters& p) { return {{p.A - 1, 5}}; }
  static double V_scale(const Parameters& p) { return p.V_s; }
  template <class T, class P>
  static T modulation(const T& u, const FrictionConstants<P>& c) {
    const T creep = u * c[1];
    const T static_part = c[0] * T(decay(T(-u * u)));
    return T(1.0 + static_part) * T(creep * T(inverse_sqrt(T(1.0 + creep * creep))));
  }
  static double factor(const Parameters& p) { return p.mu_c; }
  template <class T>
  static T load(const ContactForce<T>& contact) {
    return contact.F_n;
  }
  // Returns the friction force of rigid bristles under the load R_n, at V_0 far above V_s.
  static double rigid(const Parameters& p, double R_n) { return factor(p) * R_n; }
};

}  // namespace bristle
