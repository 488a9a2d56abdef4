#include "checks/work_tree.hpp"

#include "checks/comparison.hpp"
#include "experiment/input_error.hpp"

#include <fmt/format.h>
#include <cstdio>
#include <filesystem>

namespace bristle {
namespace fs = std::filesystem;
namespace {

struct Outcome {
  int code;
  std::string output;  // of both streams
};

Outcome run(const std::string& command) {
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (!pipe) throw RunError(fmt::format("cannot start: {}", command));
  Outcome out{0, ""};
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) out.output.append(buffer, n);
  out.code = pclose(pipe);
  while (!out.output.empty() && out.output.back() == '\n') out.output.pop_back();
  return out;
}

}  // namespace

void require_clean_work_tree(const std::string& folder) {
  const fs::path path = fs::absolute(fs::path(folder) / "").lexically_normal().parent_path();
  const fs::path parent = path.parent_path();
  if (!fs::is_directory(parent))
    throw InputError(fmt::format("--reference {}: there is no folder {}", folder, parent.string()));
  if (run("git --version").code != 0)
    throw InputError(
        "git is not there: a reference is recorded beside the commit that it follows from; install git");
  const std::string git = fmt::format("git -C {} ", shell_quoted(parent.string()));
  if (const Outcome top = run(git + "rev-parse --is-inside-work-tree"); top.code != 0)
    throw InputError(
        fmt::format("--reference {}: not in a git work tree: {}; references belong to the program's "
                    "repository",
                    folder, top.output));
  const std::string others = shell_quoted(":(exclude,literal)" + path.filename().string());
  const Outcome status = run(git + "status --porcelain --untracked-files=all -- :/ " + others);
  if (status.code != 0) throw InputError(fmt::format("--reference {}: git: {}", folder, status.output));
  if (!status.output.empty())
    throw InputError(
        fmt::format("--reference {}: the work tree differs from its commit; commit or stash first:\n{}",
                    folder, status.output));
}

}  // namespace bristle
