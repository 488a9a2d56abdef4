#pragma once

#include <optional>
#include <string>
#include <vector>

namespace bristle::cli {

struct RunOptions {
  std::string experiment, output;  // empty output: results/<name>.h5
  std::vector<std::string> set;
  std::string tier = "full";
  std::optional<std::string> shard;  // "i/N"; none: all points
  int threads = 0;                   // 0: all cores
  std::string instruction_set;       // empty: the widest available
  bool force = false, quiet = false;
  std::string command_line;
};

// The commands `run` and `validate`. They return the exit code and throw InputError or RunError.
int run_command(const RunOptions& options);
int validate_command(const RunOptions& options);

// The command `schema`: prints the schema of experiment files for editors.
int schema_command();

}  // namespace bristle::cli
