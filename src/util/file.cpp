#include "util/file.hpp"

#include "util/error.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <iterator>
#include <sys/stat.h>
#include <unistd.h>

namespace bristle {
namespace fs = std::filesystem;
namespace {

// Returns true if path still names the descriptor's file, which may have been renamed between opening and
// locking.
bool still_named(int descriptor, const std::string& path) {
  struct stat opened {
  }, named{};
  return fstat(descriptor, &opened) == 0 && stat(path.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

// Flushes path to the disk. file: the file whose data are flushed, for messages
void flush_to_disk(const std::string& file, const std::string& path, int flags) {
  const int descriptor = open(path.c_str(), flags | O_CLOEXEC);
  const bool done = descriptor >= 0 && fsync(descriptor) == 0;
  const int reason = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!done)
    throw RunError(fmt::format("{}: cannot be flushed to the disk: {}", file, system_reason(reason)));
}

// Returns, for messages, what stands at path itself, not behind a symbolic link, if it is not a regular file.
std::string special_file(const std::string& path) {
  struct stat found {};
  if (lstat(path.c_str(), &found) != 0 || S_ISREG(found.st_mode)) return "";
  if (S_ISDIR(found.st_mode)) return "a folder; give a file name";
  if (S_ISLNK(found.st_mode))
    return "a symbolic link, which is not followed; give the name of the file itself";
  return "a device, pipe or socket; give the name of a file";
}

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw InputError(fmt::format("{}: is {}; nothing was written", path, what));
}

void require_regular_or_none(const std::string& path) {
  if (fs::path(path).filename().empty()) refuse(path, "a folder; give a file name");
  if (const std::string what = special_file(path); !what.empty()) refuse(path, what);
}

// Returns true if the file can be the remainder of one that begins with start: its beginning, or zeros,
// because the first bytes of an HDF5 file are written last.
bool may_be_partial(const std::string& path, const std::string& start) {
  std::string found(start.size(), '\0');
  std::ifstream in = open_input(path);
  in.read(found.data(), std::streamsize(found.size()));
  found.resize(std::size_t(in.gcount()));
  return start.compare(0, found.size(), found) == 0 || found.find_first_not_of('\0') == std::string::npos;
}

// Appends the unread rest of a file to bytes. Returns 0, or errno if reading fails.
int read_all(int descriptor, std::string& bytes) {
  std::string block(std::size_t(1) << 20, '\0');
  for (;;) {
    const ssize_t got = read(descriptor, block.data(), block.size());
    if (got == 0) return 0;
    if (got < 0 && errno != EINTR) return errno;
    if (got > 0) bytes.append(block, 0, std::size_t(got));
  }
}

// Returns true if one of the texts occurs in the rest of the stream.
bool contains_one(std::istream& in, const std::vector<std::string>& texts) {
  std::size_t longest = 1;
  for (const std::string& text : texts) longest = std::max(longest, text.size());
  std::string window, block(std::size_t(1) << 20, '\0');
  while (in.read(block.data(), std::streamsize(block.size())) || in.gcount() > 0) {
    window.append(block, 0, std::size_t(in.gcount()));
    for (const std::string& text : texts)
      if (window.find(text) != std::string::npos) return true;
    window.erase(0, window.size() - std::min(window.size(), longest - 1));
  }
  return false;
}

}  // namespace

std::string system_reason(int error) {
  const std::string reason = std::strerror(error);
  switch (error) {
    case EMFILE: return reason + "; raise the limit of the shell, for instance by `ulimit -n 256`";
    case EFBIG: return reason + "; raise the limit of the shell (`ulimit -f`), or use another file system";
    case ENOSPC: return reason + "; is the disk full?";
    default: return reason;
  }
}

bool is_of_the_system(int error) {
  for (const int known : {EMFILE, ENFILE, EIO, ENOSPC, EDQUOT, EFBIG, EAGAIN, ENOMEM, ESTALE})
    if (error == known) return true;
  return false;
}

void throw_system_reason(const std::string& what, int error) {
  const std::string text = fmt::format("{}: {}", what, system_reason(error));
  if (is_of_the_system(error)) throw SystemError(text);
  throw InputError(text);
}

std::ifstream open_input(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in && errno != ENOENT) throw_system_reason(path + ": cannot be read", errno);
  return in;
}

void require_read(const std::ios& in, const std::string& path) {
  if (in.bad()) throw_system_reason(path + ": cannot be read", errno);
}

bool is_of_kind(const std::string& path, const FileKind& kind) {
  std::ifstream in = open_input(path);
  std::string start(kind.start.size(), '\0');
  in.read(start.data(), std::streamsize(start.size()));
  require_read(in, path);
  return in && start == kind.start && (kind.marks.empty() || contains_one(in, kind.marks));
}

void require_replaceable(const std::string& output, const FileKind& kind) {
  const std::string partial = output + ".partial";
  for (const std::string& path : {output, partial}) require_regular_or_none(path);
  std::error_code error;
  if (const auto size = fs::file_size(output, error); !error && size > 0 && !is_of_kind(output, kind))
    throw InputError(fmt::format("{}: is not {}, and would be replaced; choose another name for the output",
                                 output, kind.name));
  const bool exists = fs::exists(partial, error);
  if (exists && (fs::hard_link_count(partial, error) > 1 || !may_be_partial(partial, kind.start)))
    throw InputError(
        fmt::format("{}: is not the remainder of {}, and would be replaced; move it, or choose another name "
                    "for the output",
                    partial, kind.name));
}

int lock_file(const std::string& result, const std::string& path) {
  std::error_code error;
  const fs::path folder = fs::path(result).parent_path();
  if (!folder.empty()) fs::create_directories(folder, error);
  const std::string reason = error ? error.message() : "";
  for (const std::string& name : {result, path}) require_regular_or_none(name);
  for (;;) {
    const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor < 0 && is_of_the_system(errno))
      throw_system_reason(fmt::format("{}: cannot be written: {}", result, path), errno);
    if (descriptor < 0)
      throw InputError(fmt::format("{}: cannot be written: {}: {}; choose another name for the output",
                                   result, path, reason.empty() ? std::strerror(errno) : reason));
    struct flock whole {};
    whole.l_type = F_WRLCK;
    const bool locked = fcntl(descriptor, F_OFD_SETLK, &whole) == 0;
    const int error_of_lock = errno;
    if (locked && still_named(descriptor, path)) return descriptor;
    ::close(descriptor);
    if (!locked && error_of_lock != EAGAIN && error_of_lock != EACCES)
      throw RunError(
          fmt::format("{}: cannot be locked: {}; choose an output on a file system that supports locks", path,
                      std::strerror(error_of_lock)));
    if (!locked)
      throw RunError(fmt::format(
          "{}: another run is writing it; wait until it ends, or choose another name for the output",
          result));
  }
}

std::string not_a_file(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status) || fs::is_regular_file(status)) return "";
  if (fs::is_directory(status)) return "a folder; give the name of a file in it";
  return "a device, pipe or socket; write its contents to a file first";
}

std::string read_file(const std::string& path, std::uintmax_t max_bytes) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  const auto fail = [&](const std::string& why) {
    throw InputError(fmt::format("{}: cannot be read: {}", path, why));
  };
  if (status.type() == fs::file_type::unknown) fail(error.message());  // a folder without permission
  if (!fs::exists(status)) throw MissingFile(path + ": cannot be read: no such file");
  if (const std::string what = not_a_file(path); !what.empty()) fail(what);
  if (fs::file_size(path, error) > max_bytes) fail(fmt::format("more than {} bytes", max_bytes));
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw_system_reason(path + ": cannot be read", errno);
  std::string bytes;
  const int reason = read_all(descriptor, bytes);
  ::close(descriptor);
  if (reason != 0) throw_system_reason(path + ": cannot be read", reason);
  return bytes;
}

WholeFile::WholeFile(std::string path, const FileKind& kind)
    : path_(std::move(path)), partial_(path_ + ".partial") {
  require_replaceable(path_, kind);
  file_ = lock_file(path_, partial_);
  if (ftruncate(file_, 0) != 0) error_ = errno;
}

WholeFile::~WholeFile() {
  std::error_code ignored;
  if (!published_) fs::remove(partial_, ignored);
  ::close(file_);
}

void WholeFile::write(const std::string& bytes) {
  for (std::size_t at = 0; at < bytes.size() && error_ == 0;) {
    const ssize_t written = ::write(file_, bytes.data() + at, bytes.size() - at);
    if (written > 0) at += std::size_t(written);
    else if (written == 0 || errno != EINTR) error_ = written == 0 ? ENOSPC : errno;
  }
}

void WholeFile::close() const {
  if (error_ != 0)
    throw SystemError(fmt::format("{}: cannot be written completely: {}", path_, system_reason(error_)));
}

void WholeFile::publish() {
  flush_to_disk(partial_, partial_, O_RDONLY);
  std::error_code error;
  fs::rename(partial_, path_, error);
  if (error) throw RunError(fmt::format("{}: cannot be renamed to {}: {}", partial_, path_, error.message()));
  published_ = true;  // the partial file has become the file; another run may write another one
  const fs::path folder = fs::path(path_).parent_path();
  flush_to_disk(path_, folder.empty() ? "." : folder.string(), O_RDONLY | O_DIRECTORY);
}

void write_whole(const std::string& path, const std::string& text, const FileKind& kind) {
  WholeFile file(path, kind);
  file.write(text);
  file.close();
  file.publish();
}

}  // namespace bristle
