#pragma once

#include "dynamics/lanes/block.hpp"

#include <vector>

namespace bristle {

// The two methods, for one instruction set. Each tries steps of all occupied lanes until a lane has an event.
struct Kernels {
  const char* target;
  int width;  // numbers in one vector
  Events (*explicit_steps)(Block&);
  Events (*implicit_steps)(Block&);
};

// Those that this processor can run, the widest vectors first. All give the same numbers. None without fused
// multiply-add: without it the numbers would be others.
std::vector<const Kernels*> available_kernels();

// Throws std::runtime_error with the remedy if there are none.
const Kernels& best_kernels();

}  // namespace bristle
