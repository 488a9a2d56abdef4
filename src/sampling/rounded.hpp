#pragma once

namespace bristle {

// Returns the value to seven digits. Quantiles differ between libraries of elementary functions in the last
// bit, and must not: points are known by their values. Tables of samples are easier to read, too.
double rounded(double value);

}  // namespace bristle
