#pragma once

#include "rates.hpp"
#include "bristle/simd/kernels.hpp"

#include <nlohmann/json.hpp>

namespace bristle::bench {

// Cycles per lane-step (one step of one lane) of the kernel far from the pole, or of that of rods, with all
// lanes full, the throughputs of the processor, and how often each instruction was executed, by its address
// in the program.
nlohmann::ordered_json kernel_speed(const Kernels& kernels, Bending bending, const Rates& rates);

}  // namespace bristle::bench
