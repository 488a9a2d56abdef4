#pragma once

#include <string>

namespace bristle::cli {

struct ExportOptions {
  std::string file, output;  // empty output: the name of the result with .csv
  std::string group;         // empty: the variables
};

// The command `export`. Returns the exit code; throws InputError or RunError.
int export_command(const ExportOptions& options);

}  // namespace bristle::cli
