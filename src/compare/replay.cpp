#include "compare/replay.hpp"

#include "util/grid.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace bristle::compare {
namespace fs = std::filesystem;

ReplayCommands::ReplayCommands(const results::ResultReader& result) {
  points_ = grid_size(result.sweep_shape());
  // In a checkout of bristle the program is where `make build` puts it; elsewhere it is installed.
  const char* own_build = "build/bristle";
  const std::string program = fs::exists(own_build) ? own_build : "bristle";
  // A name that begins with a dash would be an option.
  const std::string file = (result.path().starts_with('-') ? "./" : "") + result.path();
  std::string output = "results/replay.h5";
  if (fs::path(file).lexically_normal() == output) output = "results/replay-of-replay.h5";
  begin_ = fmt::format("{} run {} -o {} --point ", program, shell_quoted(file), output);
}

std::string ReplayCommands::of_point(std::size_t index) const { return begin_ + std::to_string(index); }

Json ReplayCommands::of_all_points() const {
  Json commands = Json::array();
  for (std::size_t point = 0; point < points_; ++point) commands.push_back(of_point(point));
  return commands;
}

}  // namespace bristle::compare
