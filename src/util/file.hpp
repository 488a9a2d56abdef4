#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace bristle {

// Returns the system's words for the value of errno, with the remedy if the reason is a limit of the shell.
std::string system_reason(int error);
// Returns true if the value of errno is due to the system, and not to the name or the content of a file.
bool is_of_the_system(int error);
// Throws an error with the text `what` and the reason of errno: SystemError if the reason is due to the
// system, otherwise InputError.
[[noreturn]] void throw_system_reason(const std::string& what, int error);

// Returns a stream that reads path, without content if there is no such file. Throws InputError or
// SystemError if the file cannot be opened.
std::ifstream open_input(const std::string& path);
// Throws if reading from the stream failed, other than at the end of the file. Call it before errno changes.
void require_read(const std::ios& in, const std::string& path);

// Returns the bytes of a file. Throws InputError if it is not a regular file (reading a pipe or a device may
// never end) or has more bytes than max_bytes; MissingFile, another InputError or SystemError if it cannot be
// read.
std::string read_file(const std::string& path, std::uintmax_t max_bytes = UINTMAX_MAX);

// Returns what an input is instead of a regular file, such as "a folder; give the name of a file in it";
// empty if it is a regular file or does not exist.
std::string not_a_file(const std::string& path);

// A kind of file that the program writes. Every such file begins with start and, if there are marks,
// contains one of them.
struct FileKind {
  std::string name;  // for messages: "a result of bristle"
  std::string start;
  std::vector<std::string> marks;
};

// Returns true if the file at path is of this kind, as far as its bytes tell; it may be damaged or of another
// version.
bool is_of_kind(const std::string& path, const FileKind& kind);

// Throws InputError unless the program may write to output: nothing stands there, or an empty regular file
// (made by mktemp, or by a full disk), or a file of this kind. The temporary file output.partial must fulfil
// this, too, but may have only the beginning of such a file. Symbolic links to the file are refused, links to
// its folders are followed. Call it before computing.
void require_replaceable(const std::string& output, const FileKind& kind);

// Opens path for writing, creating it and its folder if necessary, and locks it. Returns the descriptor; the
// lock is released when the descriptor is closed or the process ends. result is the file that the run writes,
// for messages. Throws InputError if path cannot be written or is not a regular file, RunError if another run
// holds the lock.
int lock_file(const std::string& result, const std::string& path);

// A file that is written completely or not at all: it is written under a temporary name in the same folder,
// and publish() renames it. Without publish() the destructor removes the temporary file, and an existing file
// remains unchanged.
class WholeFile {
 public:
  // Creates the folder if necessary. Throws InputError if the file cannot be written there, or would replace
  // a file of another kind; RunError if another run is writing it, SystemError if the system refuses it.
  WholeFile(std::string path, const FileKind& kind);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  void write(const std::string& bytes);
  void close() const;  // throws RunError if writing failed
  // Renames the file after flushing it to the disk, so that a power cut leaves either the old file or the
  // complete new one. Call it after close(). Throws RunError.
  void publish();
  const std::string& partial() const { return partial_; }

 private:
  std::string path_, partial_;
  int file_;       // descriptor of the temporary file, which holds its lock
  int error_ = 0;  // errno of the first write that failed, or 0
  bool published_ = false;
};

// Writes a text through WholeFile. Throws as WholeFile does.
void write_whole(const std::string& path, const std::string& text, const FileKind& kind);

}  // namespace bristle
