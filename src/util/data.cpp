#include "util/data.hpp"

#include <filesystem>

namespace bristle {
namespace fs = std::filesystem;

std::optional<std::string> data_path(const std::string& name) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  for (const char* folder : {"share/bristle", "."})
    if (const fs::path found = program.parent_path().parent_path() / folder / name; fs::exists(found, error))
      return found.lexically_normal().string();
  return {};
}

}  // namespace bristle
