#pragma once

#include "bristle/model/contact.hpp"
#include "bristle/model/friction/table.hpp"

#include <memory>
#include <vector>

namespace bristle {

inline double interpolated(const ModulationTable& table, double u) { return table.at(u); }

// The experiment's own law: F_f = mu_c mu(V_R) F_n, where mu is a table of the experiment
// (docs/experiments.md). The modulation of the law is mu.
struct Custom {
  static constexpr const char* name = "custom";
  static constexpr const char* title = "the experiment's own law";
  static constexpr double load_exponent = 1;
  static constexpr double Parameters::*strength = &Parameters::mu_c;
  static FrictionConstants<double> constants(const Parameters& p) { return {{}, p.custom_friction.table}; }
  static double V_scale(const Parameters& p) {
    return p.custom_friction.table->V_scale() / p.custom_friction.V_0;
  }
  template <class T, class P>
  static T modulation(const T& u, const FrictionConstants<P>& c) {
    return interpolated(*c.table, u);
  }
  static double factor(const Parameters& p) { return p.mu_c; }
  template <class T>
  static T load(const ContactForce<T>& contact) {
    return contact.F_n;
  }
  // Returns the friction force of rigid bristles under the load R_n at the sliding speed V_0.
  static double rigid(const Parameters& p, double R_n) {
    return factor(p) * p.custom_friction.table->at(1 / V_scale(p)) * R_n;
  }
};

// Values of a friction law at ascending speeds, from mu = 0 at V_R = 0. mu is positive elsewhere, constant
// beyond the last speed, and between the speeds linear, or cubic and monotone (pchip, Fritsch and Butland
// 1984; at least 4 values).
struct FrictionValues {
  std::vector<double> V_R, mu;  // V_R in units of V0 or in m/s, mu dimensionless
  bool linear = false;
};

// Returns the table of a law, which both engines evaluate. Its slope is continuous except at the last speed.
// It rounds the corners of linear interpolation, from which it differs by at most 1e-4 of the largest mu.
// Throws std::invalid_argument if that takes too many intervals.
std::shared_ptr<const ModulationTable> modulation_table(const FrictionValues& values);

}  // namespace bristle
