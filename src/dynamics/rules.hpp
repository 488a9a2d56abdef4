#pragma once

#include "dynamics/passage.hpp"

#include <cmath>
#include <functional>

namespace bristle {

// Rules shared by the SIMD engine and the reference engine: outcome, change of method, pole rule.

// A tip whose distance from the pole, if there is one, is less than this many repulsion ranges lambda at the
// exit is pinned.
constexpr double kPinnedRanges = 20;
// Distance from the pole in repulsion ranges lambda at which c_theta/s^2 makes the equations stiff: there the
// reference engine's implicit method, or the fast engine's lanes near the pole, take over.
constexpr double kStiffRanges = 4;

constexpr double kFirstStep = 1e-5;

inline double in_plane_distance(const OdeState& y) { return std::sqrt(y[X] * y[X] + y[Y] * y[Y]); }
// s times the radial in-plane velocity; negative while the tip approaches the pole.
inline double radial_product(const OdeState& y) { return y[X] * y[VX] + y[Y] * y[VY]; }

inline Outcome outcome_at_exit(const Parameters& p, const OdeState& y) {
  const bool pinned = has_pole(p.bending) && in_plane_distance(y) < kPinnedRanges * p.lambda;
  return pinned ? Outcome::pinned : Outcome::left;
}

// Applies the pole rule to a tip at s = s_min that approaches the pole; otherwise returns false. reflect
// reverses the in-plane radial velocity. cross moves the tip to the opposite side of the pole, keeps its
// velocity, and changes its azimuth by half a turn in the sense of its motion.
bool apply_pole_rule(PoleRule rule, OdeState& y);

// The root of g in [a, b], with g(a) < 0 <= g(b): the upper end of its bracket.
double first_root(const std::function<double(double)>& g, double a, double b, double tolerance);

// First time in [a, b] at which the tip, with the state state_at(time), reaches s = s_min; infinity if it
// does not. Searches up to the closest approach, so that a step across the pole is not missed.
double pole_contact(const std::function<OdeState(double)>& state_at, double s_min, double a, double b,
                    double tolerance);

}  // namespace bristle
