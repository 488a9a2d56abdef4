#pragma once

#include <stdexcept>
#include <string>

namespace bristle {

// The input or the command line is invalid: exit code 2. The message names the place, the value and the
// remedy.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A file that does not exist.
class MissingFile : public InputError {
 public:
  using InputError::InputError;
};

// The run could not finish although its input is valid: exit code 3.
class RunError : public std::runtime_error {
 public:
  // Creates an error. saved: where finished work is kept; the message says it after the reason
  explicit RunError(const std::string& reason, const std::string& saved = "")
      : std::runtime_error(saved.empty() ? reason : reason + "; " + saved), reason_(reason) {}
  const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

// The system refused what the program needs, whatever the input is: too many open files, a device that fails.
// Exit code 3. The contents of a file are not the reason, so no file may be called damaged.
class SystemError : public RunError {
 public:
  using RunError::RunError;
};

// A signal ended the run: exit code 128 plus its number, as shells give it.
class Interrupted : public RunError {
 public:
  using RunError::RunError;
};

// Untrusted data (an archive, or a result file in one) is malformed or was modified: exit code 1. The message
// names the place in the data.
class MalformedError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace bristle
