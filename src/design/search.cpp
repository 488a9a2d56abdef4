#include "design/search.hpp"

#include <algorithm>
#include <cmath>

namespace bristle::design {
namespace {

constexpr std::size_t kLeastStage = 8;  // trials

bool dominates(const std::vector<double>& a, const std::vector<double>& b) {
  bool less = false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] > b[i]) return false;
    less = less || a[i] < b[i];
  }
  return less;
}

}  // namespace

bool better(const Score& a, const Score& b) {
  if (a.violation != b.violation) return a.violation < b.violation;
  return std::isfinite(a.violation) && dominates(a.objectives, b.objectives);
}

std::vector<std::size_t> front_of(const std::vector<Score>& scores) {
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < scores.size(); ++i)
    if (scores[i].violation == 0 &&
        std::ranges::none_of(scores, [&](const Score& s) { return better(s, scores[i]); }))
      front.push_back(i);
  std::ranges::stable_sort(front, {}, [&](std::size_t i) { return scores[i].objectives.front(); });
  return front;
}

std::vector<std::size_t> stages(std::size_t budget) {
  std::vector<std::size_t> out = {budget};
  while (out.front() / 2 >= kLeastStage) out.insert(out.begin(), out.front() / 2);
  return out;
}

}  // namespace bristle::design
