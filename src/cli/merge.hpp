#pragma once

#include <string>
#include <vector>

namespace bristle::cli {

struct MergeOptions {
  std::vector<std::string> parts;
  std::string output, command_line;
};

// The command `merge`. Returns the exit code; throws InputError or RunError.
int merge_command(const MergeOptions& options);

}  // namespace bristle::cli
