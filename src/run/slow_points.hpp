#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace bristle::run {

// Returns the processor time of this process so far, of all its threads: it stands still while other
// processes have the processors.
double processor_seconds();

// Finds the points that take unusually long. The points that are solved at the same time have equal shares of
// the processor time.
class SlowPoints {
 public:
  // now: processor time at the beginning, s
  explicit SlowPoints(double now) : first_(now), last_(now) {}
  void begin(std::size_t point) { active_[point] = 0; }
  void end(std::size_t point) { ended_ += active_.erase(point); }
  // Returns each active point, with its processor time in s, that has taken more than five minutes and ten
  // times the mean of the points that have ended; each point once. now: processor time, s
  std::vector<std::pair<std::size_t, double>> found_after(double now);

 private:
  double first_, last_;
  std::map<std::size_t, double> active_;  // processor time of each active point, s
  std::size_t ended_ = 0;
  std::set<std::size_t> found_;
};

}  // namespace bristle::run
