#pragma once

#include <functional>
#include <string>

namespace bristle {

struct ProcessResult {
  int code;            // status as returned by pclose(); 0: success
  std::string output;  // standard output
};

// Runs a shell command line. Throws RunError if it cannot be started.
ProcessResult run_process(const std::string& command);

// Runs work in a child process with limited memory and time and returns its result: HDF5 crashes on some
// malformed files, and bristle must not. Throws MalformedError with the message of an exception that work
// threw, or with the signal that ended the child process.
std::string run_isolated(const std::function<std::string()>& work);

// A temporary file with the given bytes, for libraries that read only files. The destructor removes it.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& bytes);
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile();
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace bristle
