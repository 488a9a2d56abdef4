#pragma once

#include "bristle/dynamics/ode.hpp"
#include "bristle/model/friction/table.hpp"

#include <array>

namespace bristle {

// A number with its derivatives by the components of the state, for which operators and functions apply the
// rules of differentiation. The compiler must inline them, or a Jacobian takes twice the time.
struct Dual {
  double value;
  std::array<double, kState> slopes;

  Dual() = default;  // sets nothing, as for a double
  Dual(double constant) : value(constant), slopes{} {}

  // Returns a number whose derivatives are slope(i).
  template <class Slope>
  static Dual with(double value, const Slope& slope) {
    Dual out;
    out.value = value;
    for (int i = 0; i < kState; ++i) out.slopes[i] = slope(i);
    return out;
  }
  // Returns a function of this number from the function's value and derivative.
  Dual mapped(double to, double derivative) const {
    return with(to, [&](int i) { return slopes[i] * derivative; });
  }
};

inline Dual operator-(const Dual& a) { return a.mapped(-a.value, -1); }
inline Dual operator+(const Dual& a, const Dual& b) {
  return Dual::with(a.value + b.value, [&](int i) { return a.slopes[i] + b.slopes[i]; });
}
inline Dual operator-(const Dual& a, const Dual& b) {
  return Dual::with(a.value - b.value, [&](int i) { return a.slopes[i] - b.slopes[i]; });
}
inline Dual operator*(const Dual& a, const Dual& b) {
  return Dual::with(a.value * b.value, [&](int i) { return a.slopes[i] * b.value + b.slopes[i] * a.value; });
}
inline Dual operator+(const Dual& a, double b) { return a.mapped(a.value + b, 1); }
inline Dual operator-(const Dual& a, double b) { return a.mapped(a.value - b, 1); }
inline Dual operator-(double a, const Dual& b) { return b.mapped(a - b.value, -1); }
inline Dual operator*(const Dual& a, double b) { return a.mapped(a.value * b, b); }
inline Dual operator*(double a, const Dual& b) { return b * a; }
inline Dual operator/(const Dual& a, double b) { return a.mapped(a.value / b, 1 / b); }
inline bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }

inline Dual sin(const Dual& u) { return u.mapped(sin(u.value), cos(u.value)); }
inline Dual atan(const Dual& u) { return u.mapped(atan(u.value), 1 / (1 + u.value * u.value)); }
inline Dual inverse_sqrt(const Dual& u) {
  const double y = inverse_sqrt(u.value);
  return u.mapped(y, -0.5 * y * y * y);
}
inline Dual decay(const Dual& u) {
  const double y = decay(u.value);
  return u.mapped(y, y);
}
inline Dual interpolated(const ModulationTable& table, const Dual& u) {
  return u.mapped(table.at(u.value), table.slope(u.value));
}

}  // namespace bristle
