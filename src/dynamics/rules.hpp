#pragma once

#include "dynamics/passage.hpp"

#include <boost/math/tools/roots.hpp>
#include <limits>

namespace bristle {

// Rules shared by the SIMD engine and the reference engine: outcome, change of method, pole rule.

// A tip whose distance from the pole at the exit is less than this many repulsion ranges lambda is pinned.
constexpr double kPinnedRanges = 20;
// The implicit method takes over after this many explicit steps, more than an ordinary passage needs, or at
// this distance from the pole in repulsion ranges lambda, where c_theta/s^2 makes the equations stiff.
constexpr long kExplicitSteps = 6000;
constexpr double kStiffRanges = 4;

constexpr double kFirstStep = 1e-5;

inline double in_plane_distance(const OdeState& y) { return std::sqrt(y[X] * y[X] + y[Y] * y[Y]); }
// s times the radial in-plane velocity; negative while the tip approaches the pole.
inline double radial_product(const OdeState& y) { return y[X] * y[VX] + y[Y] * y[VY]; }

inline Outcome outcome_at_exit(const Parameters& p, const OdeState& y) {
  return in_plane_distance(y) < kPinnedRanges * p.lambda ? Outcome::pinned : Outcome::left;
}

// Applies the pole rule to a tip at s = s_min that approaches the pole; otherwise returns false. reflect
// reverses the in-plane radial velocity. cross moves the tip to the opposite side of the pole, keeps its
// velocity, and changes its azimuth by half a turn in the sense of its motion.
inline bool apply_pole_rule(PoleRule rule, OdeState& y) {
  const double s2 = y[X] * y[X] + y[Y] * y[Y], inward = radial_product(y);
  if (inward >= 0) return false;
  if (rule == PoleRule::reflect) {
    y[VX] -= 2 * inward / s2 * y[X];
    y[VY] -= 2 * inward / s2 * y[Y];
  } else {
    y[THETA] += y[X] * y[VY] - y[Y] * y[VX] >= 0 ? M_PI : -M_PI;
    y[X] = -y[X];
    y[Y] = -y[Y];
  }
  return true;
}

// The root of g in [a, b], with g(a) < 0 <= g(b): the upper end of its bracket.
template <class G>
double first_root(G g, double a, double b, double tolerance) {
  std::uintmax_t iterations = 100;
  const double g_a = g(a), g_b = g(b);
  if (g_a >= 0) return a;
  if (g_b <= 0) return b;
  const auto close = [tolerance](double l, double r) { return r - l <= tolerance; };
  const auto bracket = boost::math::tools::toms748_solve(g, a, b, g_a, g_b, close, iterations);
  return bracket.second;
}

// First time in [a, b] at which the tip, with the state state_at(time), reaches s = s_min; infinity if it
// does not. Searches up to the closest approach, so that a step across the pole is not missed.
template <class StateAt>
double pole_contact(StateAt state_at, double s_min, double a, double b, double tolerance) {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (radial_product(state_at(a)) >= 0) return never;
  double nearest = b;
  if (radial_product(state_at(b)) > 0)
    nearest = first_root([&](double t) { return radial_product(state_at(t)); }, a, b, tolerance);
  const auto inside = [&](double t) { return s_min - in_plane_distance(state_at(t)); };
  if (inside(nearest) < 0) return never;
  return first_root(inside, a, nearest, tolerance);
}

}  // namespace bristle
