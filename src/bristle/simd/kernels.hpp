#pragma once

#include "bristle/simd/block.hpp"

namespace bristle {

// The kernels far from the pole, near it and for bristles without a pole, compiled for one instruction set.
// Each attempts steps of all occupied lanes until a lane has an event.
struct Kernels {
  const char* target;  // name of the instruction set
  int width;           // numbers in one vector
  Events (*far_steps)(Block&);
  Events (*near_steps)(Block&);
  Events (*rod_steps)(Block&);
};

}  // namespace bristle
