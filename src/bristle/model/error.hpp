#pragma once

#include <stdexcept>

namespace bristle {

// Thrown for input for which the model has no numbers. The message tells users why. Other exceptions are
// defects of the program or of a library.
struct ModelError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace bristle
