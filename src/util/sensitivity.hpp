#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bristle {

// A dimensionless share or a quantity, and its standard error from bootstrap resampling.
struct Estimate {
  double value, error;
};

// Saltelli's design (A. Saltelli et al., Comput. Phys. Commun. 181, 2010): base_points blocks of inputs + 2
// points in the unit cube. A block has a point a, a point b, and for each input the point a with the
// coordinate of b for this input.
std::vector<std::vector<double>> saltelli_design(std::size_t base_points, std::size_t inputs,
                                                 std::uint64_t seed);

struct SobolIndices {
  std::vector<Estimate> first, total;  // by input: S1 and ST
  std::size_t complete = 0;            // blocks whose points all have a value; the others are left out
};
// First-order indices by Saltelli's estimator (as above) and total ones by Jansen's (M. J. W. Jansen, Comput.
// Phys. Commun. 117, 1999), from the values at the points of the design. Jansen's estimator of first-order
// indices is less accurate for the inputs that matter little. Values that are not finite are missing. The
// indices are NaN if there are fewer than two complete blocks, or if all values are the same and have no
// variance to share out.
SobolIndices sobol_indices(const std::vector<double>& values, std::size_t inputs);

// The value below which this share of the values lies, by linear interpolation between the ordered values. NaN
// without values; the values must be finite.
Estimate quantile(std::vector<double> values, double share);

}  // namespace bristle
