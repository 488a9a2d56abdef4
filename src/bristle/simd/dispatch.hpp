#pragma once

#include "bristle/simd/kernels.hpp"

#include <string>
#include <vector>

namespace bristle {

// Returns the kernels that this processor can run, the widest vectors first. All give the same numbers, as
// all have fused multiply-add; in the last, SCALAR, it is a function of the C library, and slow if the
// processor has none.
std::vector<const Kernels*> available_kernels();

// Returns the preferred kernels, by default the first of available_kernels().
const Kernels& best_kernels();

// Makes best_kernels() return the kernels of this instruction set. Returns false if it is not available.
bool prefer_kernels(const std::string& target);

}  // namespace bristle
