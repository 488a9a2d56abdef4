#include "util/grid.hpp"

#include <functional>
#include <numeric>

namespace bristle {

std::size_t ravel(const std::vector<std::size_t>& at, const std::vector<std::size_t>& shape) {
  std::size_t index = 0;
  for (std::size_t d = 0; d < shape.size(); ++d) index = index * shape[d] + at[d];
  return index;
}

std::vector<std::size_t> unravel(std::size_t index, const std::vector<std::size_t>& shape) {
  std::vector<std::size_t> at(shape.size());
  for (std::size_t d = shape.size(); d-- > 0; index /= shape[d]) at[d] = index % shape[d];
  return at;
}

std::size_t grid_size(const std::vector<std::size_t>& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t(1), std::multiplies<>());
}

}  // namespace bristle
