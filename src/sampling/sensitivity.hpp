#pragma once

#include "bristle/quantity.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bristle {

// Returns Saltelli's design (A. Saltelli et al., Comput. Phys. Commun. 181, 2010): base_points blocks of
// inputs + 2 points in the unit cube. A block has a point a, a point b, and for each input the point a with
// the coordinate of b for this input.
std::vector<std::vector<double>> saltelli_design(std::size_t base_points, std::size_t inputs,
                                                 std::uint64_t seed);

// The least number of blocks from which an index follows. With this number of blocks, 3 in 100 total indices
// have an error above 0.5; with half as many blocks, 13 in 100 (Ishigami's function and Sobol's g). Twice the
// error covers the deviation of 85 in 100 indices, 81 with half as many blocks and 92 with 64 blocks.
constexpr std::size_t kLeastBlocks = 16;

// An index, and the number of blocks of the design that have the values that the index needs.
struct SobolIndex : Quantity {
  std::size_t blocks = 0;
};

struct SobolIndices {
  std::vector<SobolIndex> first, total;  // by input: S1 and ST
};
// Returns first-order indices by Saltelli's estimator (as above) and total indices by Jansen's (M. J. W.
// Jansen, Comput. Phys. Commun. 117, 1999), from the values at the points of the design. Jansen's estimator
// of first-order indices is less accurate for the inputs that matter little. Values that are not finite are
// missing: a total index follows from the blocks with values at a and at a with the coordinate of b, a
// first-order index from the blocks that also have a value at b, the variance from all a and b. An index is
// NaN if fewer than kLeastBlocks blocks have its values; if its error exceeds 0.5, because all possible
// indices, 0 to 1, are then within the error; if it lies outside of 0 to 1 by more than 3 errors and 0.1; or
// if nearly all values are the same and have no variance to share out.
SobolIndices sobol_indices(const std::vector<double>& values, std::size_t inputs);

// Returns the value below which this share of the values lies, by linear interpolation between the ordered
// values; NaN without values. The values must be finite.
Quantity quantile(std::vector<double> values, double share);

}  // namespace bristle
