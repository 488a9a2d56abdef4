#pragma once

#include "model/elementary.hpp"

namespace bristle {

// What the equations need of a number type beyond its operators. A vector type brings its own.

inline double inverse_sqrt(double x) { return 1 / std::sqrt(x); }

// Below this exponent a short-range force is e^-40 = 4e-18 of its peak: less than any other force's rounding.
constexpr double kNegligible = -40;

// exp(x) for x <= 0, and exactly 0 where that is negligible.
inline double decay(double x) { return x < kNegligible ? 0 : exp(x); }

}  // namespace bristle
