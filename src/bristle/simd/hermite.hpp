#pragma once

#include "bristle/dynamics/ode.hpp"

namespace bristle {

// Cubic with the values p and q and the slopes v and w at the
// ends of a step, as a function of the fraction u of the step.
struct Hermite {
  Hermite(double p, double q, double v, double w)
      : p(p), v(v), b(3 * (q - p) - 2 * v - w), a(2 * (p - q) + v + w) {}
  double value(double u) const { return p + u * (v + u * (b + u * a)); }
  double slope(double u) const { return v + u * (2 * b + 3 * u * a); }
  double p, v, b, a;
};

// Position and velocity of the tip within a step, as a function of the fraction u of the step. Other
// components are 0. The states at both ends must outlive it.
class TipPath {
 public:
  TipPath(const OdeState& from, const OdeState& to, double h) : from_(from), to_(to), h_(h) {}
  OdeState operator()(double u) const {
    OdeState at{};
    for (const int c : {component::X, component::Y, component::Z}) {
      const Hermite cubic = coordinate(c);
      at[c] = cubic.value(u);
      at[component::VX + c] = cubic.slope(u) / h_;
    }
    return at;
  }
  // Returns the cubic of the coordinate c: X, Y or Z.
  Hermite coordinate(int c) const {
    return {from_[c], to_[c], h_ * from_[component::VX + c], h_ * to_[component::VX + c]};
  }

 private:
  const OdeState &from_, &to_;
  double h_;
};

}  // namespace bristle
