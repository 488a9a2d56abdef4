#pragma once

#include "archive/verify.hpp"

#include <cstdint>
#include <functional>

namespace bristle {

struct Rerun {
  std::string file, place;             // "k_r = 2, k_theta = 0.3"
  std::vector<std::string> different;  // datasets and tables with other bits; empty: all are the same
};

// Computes points of a sound archive's results again, drawn by the seed from all points, and compares every
// number bit for bit. Points are reported as they are done. Throws InputError for results of another
// numerics_version, MalformedError for a result that does not hold its experiment's points.
void rerun(const Verification& archive, std::size_t count, std::uint64_t seed,
           const std::function<void(const Rerun&)>& report);

}  // namespace bristle
