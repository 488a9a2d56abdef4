#pragma once

#include <string>

namespace bristle {

struct Outcome {
  int code;
  std::string output;
};

// Runs a shell's command line. Throws RunError if it cannot be started.
Outcome run_process(const std::string& command);

}  // namespace bristle
