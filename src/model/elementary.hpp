#pragma once

#include <sleef.h>

#include <cmath>

namespace bristle {

// Elementary functions of which every bit is the same on every processor and from every compiler. The C
// library promises nothing of the kind (glibc takes other code where there is fused multiply-add), so none of
// its inexact functions may reach a number; a test looks at the program's symbols. These are SLEEF's
// deterministic scalar functions, with errors below 1 unit in the last place; below 3.5 for sin, cos and
// atan, which the equations evaluate at every step. What IEEE 754 defines exactly, as sqrt, stays with
// <cmath>.
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

}  // namespace bristle
