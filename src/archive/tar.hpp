#pragma once

#include <ctime>
#include <functional>
#include <map>
#include <string>

namespace bristle::archive {

// Contents of the files of an archive by name. The bytewise order of the names is the order in the archive.
using Files = std::map<std::string, std::string>;

// Writes an uncompressed ustar archive: regular files only, owner 0, mode 0644, all with this time. Equal
// files give equal bytes. Throws RunError for a name or a size that ustar cannot represent.
void write_tar(const Files& files, std::time_t time,
               const std::function<void(const char*, std::size_t)>& sink);

// Reads an archive, which is not trusted, into memory. It does not check that write_tar() would write the
// same bytes; tar_difference() does. Throws InputError if there is no such file, MalformedError if it cannot
// be read, if it has other than plain files, or names that lead out of it.
Files read_tar(const std::string& path);

// Reads one file of a tar archive written by git. Throws
// MalformedError if it is missing, or if the archive cannot be read.
std::string file_in_tar(const std::string& archive, const std::string& name);

// The first part of the archive (a header, a content, padding or the end) with bytes that differ from those
// that write_tar() makes of the files; empty if there is none.
std::string tar_difference(const std::string& path, const Files& files, std::time_t time);

}  // namespace bristle::archive
