#pragma once

#include <functional>
#include <string>

namespace bristle {

struct ProcessResult {
  int code;            // as pclose() returns it; 0: success
  std::string output;  // of standard output
};

// Runs a shell command line. Throws RunError if it cannot be started.
ProcessResult run_process(const std::string& command);

// Runs work in a child process with bounded memory and time and returns its text: HDF5 crashes on some malformed
// files, and bristle must not. Throws MalformedError with the message of an exception that work threw, or with
// the signal that ended the process.
std::string run_isolated(const std::function<std::string()>& work);

// Bytes as a file of a random name in the temporary folder, for libraries that read only files. The destructor
// removes it.
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
