#pragma once

#include <string>

namespace bristle::cli {

struct InfoOptions {
  std::string file;
  bool json = false;
};

// The command `info`. Returns the exit code; throws InputError or RunError.
int info_command(const InfoOptions& options);

}  // namespace bristle::cli
