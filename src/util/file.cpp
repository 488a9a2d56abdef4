#include "util/file.hpp"

#include "util/error.hpp"

#include <fmt/format.h>
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

// Whether path still names the descriptor's file: it may have been renamed between opening and locking.
bool still_named(int descriptor, const std::string& path) {
  struct stat opened {
  }, named{};
  return fstat(descriptor, &opened) == 0 && stat(path.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

void flush_to_disk(const std::string& path, int flags) {
  const int descriptor = open(path.c_str(), flags | O_CLOEXEC);
  const bool done = descriptor >= 0 && fsync(descriptor) == 0;
  const int reason = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!done) throw RunError(fmt::format("{}: {}", path, std::strerror(reason)));
}

}  // namespace

int lock_file(const std::string& result, const std::string& path) {
  std::error_code error;
  const fs::path folder = fs::path(result).parent_path();
  if (!folder.empty()) fs::create_directories(folder, error);
  const std::string reason = error ? error.message() : "";
  if (fs::is_directory(result, error))
    throw InputError(fmt::format("-o {}: is a folder; give a file name", result));
  for (;;) {
    const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0)
      throw InputError(fmt::format("-o {}: {} cannot be written: {}; choose another path with -o", result,
                                   path, reason.empty() ? std::strerror(errno) : reason));
    struct flock whole {};
    whole.l_type = F_WRLCK;
    const bool locked = fcntl(descriptor, F_OFD_SETLK, &whole) == 0;
    const int error_of_lock = errno;
    if (locked && still_named(descriptor, path)) return descriptor;
    ::close(descriptor);
    if (!locked && error_of_lock != EAGAIN && error_of_lock != EACCES)
      throw RunError(
          fmt::format("{}: cannot be locked: {}; choose a path on a file system that supports locks with -o",
                      path, std::strerror(error_of_lock)));
    if (!locked)
      throw RunError(fmt::format(
          "{}: another run is writing it; wait until it ends, or choose another path with -o", result));
  }
}

void replace_file(const std::string& from, const std::string& to) {
  flush_to_disk(from, O_RDONLY);
  std::error_code error;
  fs::rename(from, to, error);
  if (error) throw RunError(fmt::format("{}: cannot be renamed to {}: {}", from, to, error.message()));
  const fs::path folder = fs::path(to).parent_path();
  flush_to_disk(folder.empty() ? "." : folder.string(), O_RDONLY | O_DIRECTORY);
}

std::string read_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::error_code ignored;
  if (!in || fs::is_directory(path, ignored))
    throw InputError(fmt::format("{}: cannot be read: {}", path,
                                 fs::exists(path, ignored) ? "not a readable file" : "no such file"));
  return {std::istreambuf_iterator<char>(in), {}};
}

WholeFile::WholeFile(std::string path) : path_(std::move(path)), partial_(path_ + ".partial") {
  std::error_code ignored;
  const fs::path folder = fs::path(path_).parent_path();
  if (!folder.empty()) fs::create_directories(folder, ignored);
  if (fs::is_directory(path_, ignored))
    throw InputError(fmt::format("{}: is a folder; give a file name", path_));
  out_.open(partial_, std::ios::binary);
  if (!out_) throw InputError(fmt::format("{}: cannot be written: {}", path_, std::strerror(errno)));
}

WholeFile::~WholeFile() {
  std::error_code ignored;
  out_.close();
  if (!published_) fs::remove(partial_, ignored);
}

void WholeFile::write(const char* bytes, std::size_t count) { out_.write(bytes, std::streamsize(count)); }

void WholeFile::close() {
  out_.close();
  if (!out_) throw RunError(fmt::format("{}: cannot be written completely; is the disk full?", path_));
}

void WholeFile::publish() {
  replace_file(partial_, path_);
  published_ = true;
}

void write_whole(const std::string& path, const std::string& text) {
  WholeFile file(path);
  file.write(text.data(), text.size());
  file.close();
  file.publish();
}

}  // namespace bristle
