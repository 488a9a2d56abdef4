#pragma once

#include "simd/block.hpp"

namespace bristle {

// The two methods, compiled for one instruction set. Each
// attempts steps of all occupied lanes until a lane has an event.
struct Kernels {
  const char* target;  // name of the instruction set
  int width;           // numbers in one vector
  Events (*explicit_steps)(Block&);
  Events (*implicit_steps)(Block&);
};

}  // namespace bristle
