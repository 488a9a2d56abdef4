#include "util/process.hpp"

#include "util/error.hpp"

#include <fmt/format.h>
#include <cstdio>

namespace bristle {

Outcome run_process(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) throw RunError(fmt::format("cannot start: {}", command));
  Outcome out{0, ""};
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) out.output.append(buffer, n);
  out.code = pclose(pipe);
  return out;
}

}  // namespace bristle
