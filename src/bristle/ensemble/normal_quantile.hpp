#pragma once

namespace bristle {

// Returns the quantile of the standard normal distribution for a share between 1e-11 and 1 - 1e-11. The bits
// are the same on all machines.
double normal_quantile(double share);

}  // namespace bristle
