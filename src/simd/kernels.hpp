#pragma once

#include "simd/block.hpp"

#include <string>
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

// The first of them, or those that were preferred. Throws std::runtime_error with the remedy if there are
// none.
const Kernels& best_kernels();
// From now on best_kernels() are those of this instruction set, to see that the numbers are the same. False
// if this processor has none of that name.
bool prefer_kernels(const std::string& target);

}  // namespace bristle
