#pragma once

#include "bristle/simd/kernels.hpp"

#include <cstdint>
#include <stdexcept>

namespace bristle {

// The program's arithmetic is not that of every other build.
struct ArithmeticError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Throws ArithmeticError unless this program, in this process, computes the same bits as every other build:
// flags of compiler or linker such as -ffast-math, or a library that was loaded before it, may change its
// arithmetic. Its numbers would belong to no commit. Takes about two milliseconds.
void require_same_bits();

// Digests of the bits of one short passage, which comes near the pole: by these kernels, and by Boost.Odeint.
// Every build and processor gives the same two; a unit test compares them with the next two.
std::uint64_t passage_bits(const Kernels& kernels);
std::uint64_t reference_passage_bits();
constexpr std::uint64_t kPassageBits = 0x5b9a8029ba62e85e;
constexpr std::uint64_t kReferencePassageBits = 0xdaa9146abcf6b56d;

}  // namespace bristle
