#pragma once

#include <ctime>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>

namespace bristle {

// What is wrong with an archive, naming the place in it: verification failed, exit code 1.
class BadArchive : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Files of an archive by name; the map's order, bytewise, is their order in the archive.
using Files = std::map<std::string, std::string>;

// An uncompressed ustar archive: regular files only, owner 0, mode 0644, all of this time. Equal files give
// equal bytes. Throws RunError for a name or a size that ustar has no room for.
void write_tar(const Files& files, std::time_t time,
               const std::function<void(const char*, std::size_t)>& sink);

// Reads what write_tar wrote. The file is not trusted: nothing but plain files under relative names of the
// portable characters, in order and once each, no larger than the archive itself; nothing is unpacked to
// disk. Throws BadArchive for all else, InputError if there is no such file.
Files read_tar(const std::string& path);

// The place at which the archive's bytes are not those that write_tar gives for these files: headers,
// padding, what follows the end. Empty if there is none.
std::string tar_difference(const std::string& path, const Files& files, std::time_t time);

}  // namespace bristle
