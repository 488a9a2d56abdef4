#include "results/lock.hpp"

#include "experiment/input_error.hpp"

#include <fmt/format.h>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

namespace bristle {
namespace fs = std::filesystem;
namespace {

// The descriptor is of the file that has this name now: it was not renamed between opening and locking.
bool still_named(int descriptor, const std::string& path) {
  struct stat opened {
  }, named{};
  return fstat(descriptor, &opened) == 0 && stat(path.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
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
      throw InputError(fmt::format("-o {}: cannot be written: {}; give another place with -o", result,
                                   reason.empty() ? std::strerror(errno) : reason));
    struct flock whole {};
    whole.l_type = F_WRLCK;
    const bool locked = fcntl(descriptor, F_OFD_SETLK, &whole) == 0;
    const int error_of_lock = errno;
    if (locked && still_named(descriptor, path)) return descriptor;
    ::close(descriptor);
    if (!locked && error_of_lock != EAGAIN && error_of_lock != EACCES)
      throw RunError(fmt::format("{}: cannot be locked: {}; give a place with -o whose file system has locks",
                                 path, std::strerror(error_of_lock)));
    if (!locked)
      throw RunError(
          fmt::format("{}: another run is writing it; wait for that, or give another place with -o", result));
  }
}

}  // namespace bristle
