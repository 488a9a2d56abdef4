#pragma once

#include <chrono>
#include <string>

namespace bristle::run {

// Progress on standard error: on a terminal a bar with rate and
// time left, otherwise a line every 30 s, nothing if quiet.
class Progress {
 public:
  Progress(std::string what, std::size_t total, bool quiet);
  void step();                         // counts one completed item
  void note(const std::string& text);  // a line of its own, also if quiet
  void finish();                       // ends the line of the bar

 private:
  using Clock = std::chrono::steady_clock;
  void show(double seconds);

  std::string what_;
  std::size_t total_, done_ = 0;
  bool quiet_, terminal_;
  Clock::time_point start_ = Clock::now(), shown_{};
};

// "3 min 20 s"
std::string duration_text(double seconds);

}  // namespace bristle::run
