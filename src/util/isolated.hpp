#pragma once

#include <functional>
#include <string>

namespace bristle {

// What work returns, from a process of its own with bounded memory and time: HDF5 does not survive every
// malformed file, the program should. Throws BadArchive with what work threw, or how the process ended.
std::string isolated(const std::function<std::string()>& work);

// Bytes as a file that HDF5 can open, under a name of our own; removed with it.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& bytes);
  TemporaryFile(const TemporaryFile&) = delete;
  ~TemporaryFile();
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace bristle
