#pragma once

namespace bristle {

// A computed number with its estimated error. load_error is the part of the error due to the deviation of the
// load from its target; NaN if unknown.
struct Quantity {
  double value = 0, error = 0, load_error = 0;
};

}  // namespace bristle
