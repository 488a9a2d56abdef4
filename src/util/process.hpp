#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace bristle {

struct ProcessResult {
  int code;            // status as returned by pclose(); 0: success
  std::string output;  // standard output
};

// Runs a shell command line. Throws SystemError if it cannot be started.
ProcessResult run_process(const std::string& command);

// Returns the name of this machine.
std::string host_name();

struct Limits {
  long seconds;        // processor time
  std::size_t memory;  // bytes, beyond the memory of this process
};

// Runs work in a child process with limited memory and time and returns its result: HDF5 crashes on some
// malformed files, and bristle must not. Throws MalformedError with the message of an exception that work
// threw, or with the signal that ended the child process; SystemError if work threw one, or if the process
// cannot be started. The child ends with this process.
std::string run_isolated(const std::function<std::string()>& work, const Limits& limits);

}  // namespace bristle
