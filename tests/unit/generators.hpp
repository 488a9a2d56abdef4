#pragma once

#include "catch.hpp"
#include "bristle/model/energy.hpp"
#include "bristle/model/friction/laws.hpp"

#include <cmath>
#include <rapidcheck.h>

// Random input for property tests.
namespace rc {

// A property as a section of a test case, for any version of Catch2.
template <class Testable>
void prop(const std::string& description, Testable&& testable) {
  SECTION(description) { CHECK(check(description, std::forward<Testable>(testable))); }
}

}  // namespace rc

namespace bristle::testing {

inline double uniform(double from, double to) {
  constexpr int steps = 1 << 20;
  return from + (to - from) * *rc::gen::inRange(0, steps + 1) / steps;
}

inline double log_uniform(double from, double to) { return std::exp(uniform(std::log(from), std::log(to))); }

// Random parameters within the ranges of the paper, with one of its two friction laws, any bending and any
// contact.
inline Parameters random_parameters() {
  Parameters p;
  p.bending = *rc::gen::element(Bending::polar, Bending::polar_as_printed, Bending::rod);
  p.contact = *rc::gen::element(Contact::wall, Contact::hertz);
  p.section = *rc::gen::element(Section::round, Section::oval);
  p.friction = *rc::gen::arbitrary<bool>() ? FrictionLaw::nss : FrictionLaw::coulomb;
  p.k_r = log_uniform(2, 100);
  p.k_theta = log_uniform(0.3, 10);
  p.k_phi = uniform(1.5, 3.5);
  p.C = chi_C_peak_at_V_s(p.A);
  return p;
}

// The same, with a bending that conserves energy.
inline Parameters random_conserving_parameters() {
  Parameters p = random_parameters();
  if (!conserves_energy(p.bending)) p.bending = Bending::polar;
  return p;
}

// A random tip off the pole and near the slab, with angles that need not agree with its position.
inline State<double> random_state(double z_0) {
  const double theta = uniform(-3, 3), s = uniform(0.01, 1), z = z_0 - uniform(-2e-3, 0.1);
  const Vector3<double> v{uniform(-1, 2), uniform(-1, 1), uniform(-1, 1)};
  return {{s * std::cos(theta), s * std::sin(theta), z},
          v,
          theta + uniform(-1, 1),
          std::atan2(z, s) + uniform(-0.5, 0.5)};
}

}  // namespace bristle::testing
