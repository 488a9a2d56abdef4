#pragma once

#include <functional>
#include <string>

namespace bristle {

// Returns the function of one variable that the text describes: numbers, the variable, pi, + - * / ^,
// parentheses, and the functions abs, atan, cos, exp, log, sin, sqrt and tanh. It uses the elementary
// functions of the equations, so that its bits are the same on all machines; libraries for formulas call the
// functions of the C library. Throws std::invalid_argument with the position in the text and what is allowed
// there.
std::function<double(double)> parse_formula(const std::string& text, const std::string& variable);

}  // namespace bristle
