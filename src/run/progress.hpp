#pragma once

#include <chrono>
#include <string>

namespace bristle::run {

// Shows progress on standard error: on a terminal a bar with rate and time left, otherwise a line after 3 s
// and then every 30 s, nothing if quiet. Each line begins with the name of what is done and the stage.
class Progress {
 public:
  Progress(const std::string& name, std::size_t total, bool quiet);
  // Shows the next stage, which has no count, such as "writing results/fig4.h5". Off a terminal, the stage of
  // a long run has a line of its own; a short run shows none.
  void stage(const std::string& text);
  void step();                           // counts one completed item
  void add_passages(std::size_t count);  // counts passages of items, completed or not
  void note(const std::string& text);    // writes a line of its own, also if quiet
  void finish();                         // ends the line of the bar, or removes the line of a stage

 private:
  using Clock = std::chrono::steady_clock;
  void show_if_due();
  void show(double seconds);

  std::string name_;
  std::size_t total_, done_ = 0, passages_ = 0;
  bool quiet_, terminal_, shown_ = false, bar_ = true;
  Clock::time_point start_ = Clock::now();
  double due_;  // seconds from the start at which the next line is due
};

// Returns a duration such as "3 min 20 s".
std::string duration_text(double seconds);

}  // namespace bristle::run
