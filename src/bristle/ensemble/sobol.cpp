#include "bristle/ensemble/sobol.hpp"

#include "bristle/random.hpp"

#include <boost/random/sobol.hpp>

namespace bristle {
namespace {

std::uint32_t reversed(std::uint32_t x) {
  x = ((x & 0x55555555) << 1) | ((x >> 1) & 0x55555555);
  x = ((x & 0x33333333) << 2) | ((x >> 2) & 0x33333333);
  x = ((x & 0x0f0f0f0f) << 4) | ((x >> 4) & 0x0f0f0f0f);
  return __builtin_bswap32(x);
}

// Flips each bit depending on the higher bits and the seed.
std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed) {
  x = reversed(x) + seed;
  x ^= x * 0x6c50b47c;
  x ^= x * 0xb82f1e52;
  x ^= x * 0xc7afe638;
  x ^= x * 0x8d22f6e6;
  return reversed(x);
}

}  // namespace

std::vector<std::vector<double>> sobol_points(std::size_t points, std::size_t dimensions,
                                              std::uint64_t seed) {
  boost::random::sobol_engine<std::uint32_t, 32> engine(dimensions);
  std::vector<std::vector<double>> out(points, std::vector<double>(dimensions));
  // The engine leaves out the origin, which scrambling moves to a place as good as any other.
  for (std::size_t i = 0; i < points; ++i)
    for (std::size_t d = 0; d < dimensions; ++d) {
      const auto x = i == 0 ? 0 : std::uint32_t(engine());
      out[i][d] = (scrambled(x, std::uint32_t(split_mix(seed + d * kSplitMixStep))) + 0.5) * 0x1p-32;
    }
  return out;
}

}  // namespace bristle
