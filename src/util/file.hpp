#pragma once

#include <string>

namespace bristle {

// Opens path, creating it and its folder if need be, and locks it: the lock goes with the descriptor that is
// returned, or with the process. result is what messages speak of. Throws InputError if it cannot be written
// there, RunError if another run has it.
int lock_file(const std::string& result, const std::string& path);

// Gives a finished file its name: after a power cut there is the old file or the whole new one. Throws
// RunError.
void replace_file(const std::string& from, const std::string& to);

}  // namespace bristle
