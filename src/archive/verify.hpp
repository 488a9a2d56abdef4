#pragma once

#include "archive/bag.hpp"
#include "experiment/document.hpp"

namespace bristle {

// What verification found. The archive is not trusted; nothing of it is unpacked to disk.
struct Verification {
  Problems problems;  // empty: the archive is sound
  std::string folder, version, commit, identifier, draft;
  std::size_t files = 0, bytes = 0, results = 0;
  std::map<std::string, std::string> result_bytes;  // result files by name, if the archive is sound
};

// Every hash and payload digest, nothing missing, added or changed, the metadata's required keys, and that
// the bytes are those that the program writes for these files. Throws InputError if there is no such file.
Verification verify_archive(const std::string& path);

}  // namespace bristle
