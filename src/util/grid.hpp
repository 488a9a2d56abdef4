#pragma once

#include <cstddef>
#include <vector>

namespace bristle {

// Index of a position in a row-major grid of this shape (the last dimension varies fastest), and its inverse.
std::size_t ravel(const std::vector<std::size_t>& at, const std::vector<std::size_t>& shape);
std::vector<std::size_t> unravel(std::size_t index, const std::vector<std::size_t>& shape);

// Number of points of the grid; 1 for an empty shape.
std::size_t grid_size(const std::vector<std::size_t>& shape);

}  // namespace bristle
