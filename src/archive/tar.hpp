#pragma once

#include <ctime>
#include <map>
#include <string>

namespace bristle::archive {

// Contents of the files of an archive by name. The bytewise order of the names is the order in the archive.
using Files = std::map<std::string, std::string>;

// Returns the bytes of an uncompressed ustar archive: regular files only, owner 0, mode 0644, all with this
// time. Equal files give equal bytes. Throws RunError for a name or a size that ustar cannot represent.
std::string write_tar(const Files& files, std::time_t time);

// Returns the bytes of the file of an archive. Throws InputError if there is no such regular file,
// MalformedError if it is larger than any archive.
std::string read_archive(const std::string& path);

// Reads an archive, which is not trusted. It does not check that write_tar() would write the same bytes;
// tar_difference() does. Throws MalformedError if it cannot be read, if it has other than plain files, or
// names that lead out of it.
Files read_tar(const std::string& bytes);

// Reads one file of a tar archive written by git. Throws MalformedError if it is missing, or if the archive
// cannot be read.
std::string file_in_tar(const std::string& bytes, const std::string& name);

// Returns the first part of the archive (a header, a content, padding or the end) whose bytes differ from the
// bytes that write_tar() makes of the files; empty if there is none.
std::string tar_difference(const std::string& bytes, const Files& files, std::time_t time);

}  // namespace bristle::archive
