#pragma once

#include "archive/verify.hpp"

#include <cstdint>
#include <functional>

namespace bristle::archive {

// Comparison of one point.
struct Rerun {
  std::string file, place;             // place: "k_r = 2, k_theta = 0.3"
  std::vector<std::string> different;  // datasets and tables that differ in any bit
};

// Computes count randomly drawn points of the results of a verified archive again and compares every number
// bit for bit. Calls report after each point. Throws InputError for results of another numerics_version,
// MalformedError for a result without the points of its experiment.
void rerun(const Verification& archive, std::size_t count, std::uint64_t seed,
           const std::function<void(const Rerun&)>& report);

}  // namespace bristle::archive
