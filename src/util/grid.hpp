#pragma once

#include <cstddef>
#include <vector>

namespace bristle {

// Returns the index of a position in a row-major grid of this shape (the last dimension varies fastest).
std::size_t ravel(const std::vector<std::size_t>& at, const std::vector<std::size_t>& shape);
// Returns the position of an index: the inverse of ravel().
std::vector<std::size_t> unravel(std::size_t index, const std::vector<std::size_t>& shape);

// Returns the number of points of the grid; 1 for an empty shape.
std::size_t grid_size(const std::vector<std::size_t>& shape);

}  // namespace bristle
