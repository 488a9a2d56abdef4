#pragma once

#include <cmath>

// SLEEF's functions, as sleef.h declares them. That header includes all vector intrinsics of the processor,
// too, which takes longer to read than the whole model.
extern "C" {
double Sleef_cinz_sind1_u35purec(double);
double Sleef_cinz_cosd1_u35purec(double);
double Sleef_cinz_atand1_u35purec(double);
double Sleef_cinz_tand1_u10purec(double);
double Sleef_cinz_asind1_u10purec(double);
double Sleef_cinz_acosd1_u10purec(double);
double Sleef_cinz_expd1_u10purec(double);
double Sleef_cinz_logd1_u10purec(double);
double Sleef_cinz_powd1_u10purec(double, double);
double Sleef_cinz_cbrtd1_u10purec(double);
double Sleef_cinz_erfcd1_u15purec(double);
}

namespace bristle {

// Returns the sine of x (rad). This and the following elementary functions have bit-identical results on
// every processor and from every compiler: they are SLEEF's deterministic scalar functions. Their errors are
// below 3.5 units in the last place for sin, cos and atan, which the equations evaluate at every step, and
// below 1 unit for the others (1.5 for erfc).
// The C library does not guarantee identical bits (glibc selects other code where fused multiply-add is
// available), so no number may depend on its inexact functions; a test checks the program's symbols.
// Functions that IEEE 754 defines exactly, such as sqrt, come from <cmath>.
inline double sin(double x) { return Sleef_cinz_sind1_u35purec(x); }
inline double cos(double x) { return Sleef_cinz_cosd1_u35purec(x); }
inline double atan(double x) { return Sleef_cinz_atand1_u35purec(x); }
inline double tan(double x) { return Sleef_cinz_tand1_u10purec(x); }
inline double asin(double x) { return Sleef_cinz_asind1_u10purec(x); }
inline double acos(double x) { return Sleef_cinz_acosd1_u10purec(x); }
inline double exp(double x) { return Sleef_cinz_expd1_u10purec(x); }
inline double log(double x) { return Sleef_cinz_logd1_u10purec(x); }
inline double pow(double x, double y) { return Sleef_cinz_powd1_u10purec(x, y); }
inline double cbrt(double x) { return Sleef_cinz_cbrtd1_u10purec(x); }
inline double erfc(double x) { return Sleef_cinz_erfcd1_u15purec(x); }

// Functions that the equations require of a number type beyond its operators. A SIMD type overloads them.

inline double inverse_sqrt(double x) { return 1 / std::sqrt(x); }
template <class T>
T select(bool condition, const T& yes, const T& no) {
  return condition ? yes : no;
}
inline double max(double a, double b) { return a < b ? b : a; }

// Below this exponent a short-range force is less than e^-40 = 4e-18 of its peak: below the rounding error of
// any other force.
constexpr double kNegligible = -40;

// Returns exp(x) for x <= 0; exactly 0 below kNegligible.
inline double decay(double x) { return x < kNegligible ? 0 : exp(x); }

}  // namespace bristle
