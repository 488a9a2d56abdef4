#pragma once

#include <cstddef>
#include <fstream>
#include <string>

namespace bristle {

// The bytes of a file. Throws InputError if it cannot be read.
std::string read_file(const std::string& path);

// Opens path for writing, creating it and its folder if necessary, and locks it. Returns the descriptor; the lock
// is released when it is closed or the process ends. Messages name result, the file that the run writes. Throws
// InputError if it cannot be written, RunError if another run holds the lock.
int lock_file(const std::string& result, const std::string& path);

// Renames a finished file, after flushing it to the disk: a power cut leaves the old file or the whole new one.
// Throws RunError.
void replace_file(const std::string& from, const std::string& to);

// A file that is written whole or not at all: under a temporary name beside its own, which publish() replaces.
// Without publish() the destructor removes the temporary file and an existing file stays as it was.
class WholeFile {
 public:
  // Creates the folder if necessary. Throws InputError if the file cannot be written there.
  explicit WholeFile(std::string path);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  void write(const char* bytes, std::size_t count);
  void close();    // throws RunError if not everything could be written
  void publish();  // call after close(); throws RunError
  const std::string& partial() const { return partial_; }

 private:
  std::string path_, partial_;
  std::ofstream out_;
  bool published_ = false;
};

// Writes a text as a whole file. Throws as WholeFile does.
void write_whole(const std::string& path, const std::string& text);

}  // namespace bristle
