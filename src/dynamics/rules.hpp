#pragma once

#include "dynamics/passage.hpp"

#include <boost/math/tools/roots.hpp>
#include <limits>

namespace bristle {

// What both engines do alike: when the methods change over, and what a passage's numbers follow from.

// A tip that ends within this many repulsion ranges of the axis is held there: pinned.
constexpr double kPinnedRanges = 20;
// Where the explicit method hands over: a bristle that needs more steps than an ordinary passage,
// or comes so near the axis that c_theta/s^2 makes it stiff.
constexpr long kExplicitSteps = 6000;
constexpr double kStiffRanges = 4;

constexpr double kFirstStep = 1e-5;

inline double in_plane_distance(const OdeState& y) { return std::sqrt(y[X] * y[X] + y[Y] * y[Y]); }
inline double radial_product(const OdeState& y) { return y[X] * y[VX] + y[Y] * y[VY]; }

inline Outcome outcome_at_exit(const Parameters& p, const OdeState& y) {
  return in_plane_distance(y) < kPinnedRanges * p.lambda ? Outcome::pinned : Outcome::left;
}

// The pole rule for a tip at s = s_min; only an approaching one is concerned. Either its in-plane radial
// velocity changes sign and all else stays; or the tip is put to the other side of the axis, with its
// velocity, and its azimuth is half a turn farther in the sense in which it passes.
inline bool answer_pole(PoleRule rule, OdeState& y) {
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

// First time in [a, b] at which g, with g(a) < 0 <= g(b), is zero.
template <class G>
double root_in(G g, double a, double b, double tolerance) {
  std::uintmax_t iterations = 100;
  const double g_a = g(a), g_b = g(b);
  if (g_a >= 0) return a;
  if (g_b <= 0) return b;
  const auto close = [tolerance](double l, double r) { return r - l <= tolerance; };
  const auto bracket = boost::math::tools::toms748_solve(g, a, b, g_a, g_b, close, iterations);
  return bracket.second;
}

// Time in [a, b] at which the tip, at state_at(time), comes down to s = s_min, or infinity. The closest
// approach counts, so that a step across the axis is not missed.
template <class StateAt>
double pole_contact(StateAt state_at, double s_min, double a, double b, double tolerance) {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (radial_product(state_at(a)) >= 0) return never;
  double nearest = b;
  if (radial_product(state_at(b)) > 0)
    nearest = root_in([&](double t) { return radial_product(state_at(t)); }, a, b, tolerance);
  const auto inside = [&](double t) { return s_min - in_plane_distance(state_at(t)); };
  if (inside(nearest) < 0) return never;
  return root_in(inside, a, nearest, tolerance);
}

// Outcome, ratios and energy residual of a passage that reached its exit, from its end.
void complete(const PassageTask& task, Passage& passage);

}  // namespace bristle
