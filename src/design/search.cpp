#include "design/search.hpp"

#include <algorithm>
#include <cmath>

namespace bristle::design {
namespace {

constexpr std::size_t kLeastStage = 8;  // trials

}  // namespace

bool better(const Score& a, const Score& b) {
  if (a.violation != b.violation) return a.violation < b.violation;
  return std::isfinite(a.violation) && a.objective < b.objective;
}

std::vector<std::size_t> stages(std::size_t budget) {
  std::vector<std::size_t> out = {budget};
  while (out.front() / 2 >= kLeastStage) out.insert(out.begin(), out.front() / 2);
  return out;
}

}  // namespace bristle::design
