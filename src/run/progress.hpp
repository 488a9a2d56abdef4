#pragma once

#include <chrono>
#include <string>

namespace bristle {

// Progress on standard error: a bar with rate and time left on a terminal, a plain line now and then
// elsewhere, nothing if quiet.
class Progress {
 public:
  Progress(std::string what, std::size_t total, bool quiet);
  void step();    // one more is done
  void finish();  // ends the bar's line

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

}  // namespace bristle
