#pragma once

#include "dynamics/lanes/block.hpp"

namespace bristle {

// The two methods, for one instruction set. Each tries steps of all occupied lanes until a lane has an event.
struct Kernels {
  const char* target;
  Events (*explicit_steps)(Block&);
  Events (*implicit_steps)(Block&);
};

}  // namespace bristle
