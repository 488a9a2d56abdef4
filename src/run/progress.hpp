#pragma once

#include <chrono>
#include <string>

namespace bristle::run {

// Progress on standard error: on a terminal a bar with rate and time left, otherwise a line after 3 s and
// then every 30 s, nothing if quiet.
class Progress {
 public:
  Progress(std::string what, std::size_t total, bool quiet);
  void step();                           // counts one completed item
  void add_passages(std::size_t count);  // of items that need not be completed
  void note(const std::string& text);    // a line of its own, also if quiet
  void finish();                         // ends the line of the bar

 private:
  using Clock = std::chrono::steady_clock;
  void show_if_due();
  void show(double seconds);

  std::string what_;
  std::size_t total_, done_ = 0, passages_ = 0;
  bool quiet_, terminal_;
  Clock::time_point start_ = Clock::now();
  double due_;  // seconds from the start at which the next line is due
};

// "3 min 20 s"
std::string duration_text(double seconds);
// "15,300"
std::string count_text(std::size_t count);

}  // namespace bristle::run
