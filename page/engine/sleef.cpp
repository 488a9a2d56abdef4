#include "bristle/model/elementary.hpp"

// SLEEF's names for the C library's functions: SLEEF has no package for WebAssembly. Their last digits
// differ, so that numbers of the page agree with those of the program within their errors, and not in every
// bit.
extern "C" {
double Sleef_cinz_sind1_u35purec(double x) { return std::sin(x); }
double Sleef_cinz_cosd1_u35purec(double x) { return std::cos(x); }
double Sleef_cinz_atand1_u35purec(double x) { return std::atan(x); }
double Sleef_cinz_tand1_u10purec(double x) { return std::tan(x); }
double Sleef_cinz_asind1_u10purec(double x) { return std::asin(x); }
double Sleef_cinz_acosd1_u10purec(double x) { return std::acos(x); }
double Sleef_cinz_expd1_u10purec(double x) { return std::exp(x); }
double Sleef_cinz_logd1_u10purec(double x) { return std::log(x); }
double Sleef_cinz_powd1_u10purec(double x, double y) { return std::pow(x, y); }
double Sleef_cinz_cbrtd1_u10purec(double x) { return std::cbrt(x); }
double Sleef_cinz_erfcd1_u15purec(double x) { return std::erfc(x); }
}
