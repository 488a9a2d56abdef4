#pragma once

#include "model/elementary.hpp"

namespace bristle {

// Functions that the equations require of a number type beyond its operators. A SIMD type overloads them.

inline double inverse_sqrt(double x) { return 1 / std::sqrt(x); }

// Below this exponent a short-range force is less than e^-40 =
// 4e-18 of its peak: below the rounding error of any other force.
constexpr double kNegligible = -40;

// exp(x) for x <= 0; exactly 0 below kNegligible.
inline double decay(double x) { return x < kNegligible ? 0 : exp(x); }

}  // namespace bristle
