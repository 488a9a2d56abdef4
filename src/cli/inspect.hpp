#pragma once

#include <string>

namespace bristle::cli {

// The command `info`. Returns the exit code; throws InputError or RunError.
int info_command(const std::string& file);

}  // namespace bristle::cli
