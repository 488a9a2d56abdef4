#pragma once

#include <cstddef>
#include <fstream>
#include <string>

namespace bristle {

// The bytes of a file. Throws InputError if it cannot be read.
std::string read_file(const std::string& path);

// Opens path for writing, creating it and its folder if necessary, and locks it. Returns the descriptor; the
// lock is released when the descriptor is closed or the process ends. result is the file that the run writes,
// for messages. Throws InputError if path cannot be written, RunError if another run holds the lock.
int lock_file(const std::string& result, const std::string& path);

// Renames a finished file after flushing it to the disk, so that a power cut leaves either the old file or
// the complete new one. Throws RunError.
void replace_file(const std::string& from, const std::string& to);

// A file that is written completely or not at all: it is written under a temporary name in the same folder,
// and publish() renames it. Without publish() the destructor removes the temporary file, and an existing file
// remains unchanged.
class WholeFile {
 public:
  // Creates the folder if necessary. Throws InputError if the file cannot be written there.
  explicit WholeFile(std::string path);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  void write(const char* bytes, std::size_t count);
  void close();    // throws RunError if writing failed
  void publish();  // call after close(); throws RunError
  const std::string& partial() const { return partial_; }

 private:
  std::string path_, partial_;
  std::ofstream out_;
  bool published_ = false;
};

// Writes a text through WholeFile. Throws as WholeFile does.
void write_whole(const std::string& path, const std::string& text);

}  // namespace bristle
