#pragma once

#include <cstdint>

namespace bristle {

// SplitMix64 (G. L. Steele, D. Lea, C. H. Flood, OOPSLA 2014): a pseudorandom number for each key x. Every
// bit of the result depends on every bit of x. The sequence of seed s is split_mix(s + i * kSplitMixStep), i
// = 0, 1, ...
constexpr std::uint64_t kSplitMixStep = 0x9e3779b97f4a7c15;

constexpr std::uint64_t split_mix(std::uint64_t x) {
  x += kSplitMixStep;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

}  // namespace bristle
