#pragma once

namespace bristle {

// Returns the value to seven digits. Quantiles differ between libraries of elementary functions in the last
// bit, and must not: points are known by their values. Tables of samples are easier to read, too.
double rounded(double value);

// Returns the quantile of the standard normal distribution for a share between 1e-11 and 1 - 1e-11. The bits
// are the same on all machines.
double normal_quantile(double share);

}  // namespace bristle
