#pragma once

#include <stdexcept>
#include <string>

namespace bristle {

// The input or the command line is wrong: exit code 2. The message names the place, the value and the remedy.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The run could not finish although its input is right: exit code 3.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Untrusted data, as an archive or a result file in it, is malformed or was changed: exit code 1. The message
// names the place in the data.
class MalformedError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace bristle
