#pragma once

#include "bristle/simd/kernels.hpp"

#include <cstdint>
#include <stdexcept>

namespace bristle {

// The error that the program's arithmetic differs from the arithmetic of every other build.
struct ArithmeticError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Throws ArithmeticError unless this program, in this process, computes the same bits as every other build:
// flags of compiler or linker such as -ffast-math, or a library that was loaded before it, may change its
// arithmetic. Its numbers would belong to no commit. Takes about two milliseconds.
void require_same_bits();

// Returns the digest of the bits of one short passage, which comes near the pole, by these kernels. Every
// build and processor gives the same digest; a unit test compares it with kPassageBits.
std::uint64_t passage_bits(const Kernels& kernels);
// Returns the digest of the same passage by Boost.Odeint; a unit test compares it with kReferencePassageBits.
std::uint64_t reference_passage_bits();
constexpr std::uint64_t kPassageBits = 0x5b9a8029ba62e85e;
constexpr std::uint64_t kReferencePassageBits = 0xdaa9146abcf6b56d;

}  // namespace bristle
