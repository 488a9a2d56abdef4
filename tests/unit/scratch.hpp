#pragma once

#include "util/error.hpp"

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace bristle {
namespace json {}
namespace sweep {}
namespace experiment {}
namespace results {}
namespace claims {}
namespace compare {}
namespace run {}
namespace assumptions {}
namespace archive {}
namespace cli {}
}  // namespace bristle

namespace bristle::testing {

using namespace json;
using namespace sweep;
using namespace experiment;
using namespace results;
using namespace claims;
using namespace compare;
using namespace run;
using namespace assumptions;
using namespace archive;
using namespace cli;

// A temporary folder, which the destructor removes.
class Scratch {
 public:
  Scratch() {
    std::string pattern = (std::filesystem::temp_directory_path() / "bristle-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~Scratch() { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
    return path(name);
  }

 private:
  std::filesystem::path folder_;
};

// The message of the InputError that the call throws, from the name of the file in the folder on.
template <class Call>
std::string input_error(const Scratch& folder, const Call& call) {
  try {
    call();
  } catch (const InputError& e) {
    const std::string message = e.what(), path = folder.path("");
    const auto at = message.find(path);
    return at == message.npos ? message : message.substr(at + path.size());
  }
  return "(no error)";
}

inline std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace bristle::testing
