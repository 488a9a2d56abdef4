#pragma once

#include "bristle/dynamics/passage.hpp"

#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>

namespace bristle {

// Rules shared by the SIMD engine and the reference engine: outcome, change of method, pole rule.

// Distance from the pole, in repulsion ranges lambda, below which a tip at the exit is pinned. Tips without a
// pole are never pinned.
constexpr double kPinnedRanges = 20;
// Distance from the pole, in repulsion ranges lambda, below which c_theta/s^2 makes the equations stiff: the
// implicit method of the reference engine, or the lanes near the pole of the fast engine, take over.
constexpr double kStiffRanges = 4;

// Size of the first step, and the largest step right after the pole rule, in units of r0/V0.
constexpr double kFirstStep = 1e-5;

// Returns the square of the tip's distance from the place where the coordinates are singular: the pole, the
// line s = 0, for polar coordinates, or the base, the point r = 0, for a rod.
inline double singular_square(Bending bending, const OdeState& y) {
  using namespace component;
  return y[X] * y[X] + y[Y] * y[Y] + (has_pole(bending) ? 0 : y[Z] * y[Z]);
}
inline double singular_distance(Bending bending, const OdeState& y) {
  return std::sqrt(singular_square(bending, y));
}
// Returns half the time derivative of singular_square(); it is negative while the tip approaches.
inline double singular_product(Bending bending, const OdeState& y) {
  using namespace component;
  return y[X] * y[VX] + y[Y] * y[VY] + (has_pole(bending) ? 0 : y[Z] * y[VZ]);
}

inline Outcome outcome_at_exit(const Parameters& p, const OdeState& y) {
  const bool pinned = has_pole(p.bending) && singular_distance(p.bending, y) < kPinnedRanges * p.lambda;
  return pinned ? Outcome::pinned : Outcome::left;
}

// Applies the pole rule to a tip at s = s_min. Does nothing and returns false unless the tip approaches the
// pole. reflect reverses the in-plane radial velocity. cross moves the tip to the opposite side of the pole,
// keeps its velocity, and changes its azimuth by half a turn in the sense of its motion. The tip of a rod at
// r = s_min has its radial velocity reversed, so that no bristle is compressed to nothing.
bool apply_pole_rule(const Parameters& p, OdeState& y);

// Returns the upper end of a bracket of the root of g in [a, b], where g(a) < 0 <= g(b). Returns an end of
// the interval if g does not change its sign there, as its values may be NaN.
template <class Function>
double first_root(Function g, double a, double b, double tolerance) {
  std::uintmax_t iterations = 100;
  const double g_a = g(a), g_b = g(b);
  if (!(g_a < 0)) return a;
  if (!(g_b > 0)) return b;
  const auto close = [tolerance](double l, double r) { return r - l <= tolerance; };
  return boost::math::tools::toms748_solve(g, a, b, g_a, g_b, close, iterations).second;
}

// Returns the first time in [a, b] at which a tip with the state state_at(time) is s_min from the pole, or
// the tip of a rod from its base; infinity if there is none. Searches up to the closest approach, so that a
// step across the pole is not missed.
template <class StateAt>
double pole_contact(StateAt state_at, const Parameters& p, double a, double b, double tolerance) {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (singular_product(p.bending, state_at(a)) >= 0) return never;
  double nearest = b;
  if (singular_product(p.bending, state_at(b)) > 0)
    nearest = first_root([&](double t) { return singular_product(p.bending, state_at(t)); }, a, b, tolerance);
  const auto inside = [&](double t) { return p.s_min - singular_distance(p.bending, state_at(t)); };
  if (inside(nearest) < 0) return never;
  return first_root(inside, a, nearest, tolerance);
}

}  // namespace bristle
