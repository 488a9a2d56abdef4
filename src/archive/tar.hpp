#pragma once

#include <ctime>
#include <functional>
#include <map>
#include <string>

namespace bristle {

constexpr std::size_t kTarBlock = 512;  // bytes

// Files of an archive by name; the map's order, bytewise, is their order in the archive.
using Files = std::map<std::string, std::string>;

// An uncompressed ustar archive: regular files only, owner 0, mode 0644, all of this time. Equal files give
// equal bytes. Throws RunError for a name or a size that ustar has no room for.
void write_tar(const Files& files, std::time_t time,
               const std::function<void(const char*, std::size_t)>& sink);

// A file in a tar archive as git writes it. Throws MalformedError if it is not there or the archive cannot be read.
std::string file_in_tar(const std::string& archive, const std::string& name);

// The place at which the archive's bytes are not those that write_tar gives for these files: headers,
// padding, what follows the end. Empty if there is none.
std::string tar_difference(const std::string& path, const Files& files, std::time_t time);

}  // namespace bristle
