#include "run/slow_points.hpp"

#include <algorithm>
#include <ctime>

namespace bristle::run {
namespace {

constexpr double kSlowSeconds = 300, kSlowFactor = 10;

}  // namespace

double processor_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

std::vector<std::pair<std::size_t, double>> SlowPoints::found_after(double now) {
  std::vector<std::pair<std::size_t, double>> found;
  const double share = (now - last_) / double(std::max<std::size_t>(1, active_.size()));
  const double mean = (now - first_) / double(std::max<std::size_t>(1, ended_));
  last_ = now;
  for (auto& [point, seconds] : active_) {
    seconds += share;
    if (seconds > kSlowSeconds && (ended_ == 0 || seconds > kSlowFactor * mean) &&
        found_.insert(point).second)
      found.emplace_back(point, seconds);
  }
  return found;
}

}  // namespace bristle::run
