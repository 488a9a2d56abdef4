#include "checks/work_tree.hpp"

#include "checks/comparison.hpp"
#include "util/process.hpp"
#include "util/error.hpp"

#include <fmt/format.h>
#include <filesystem>

namespace bristle {
namespace fs = std::filesystem;
namespace {

// Output of both streams, without line ends.
Outcome run(const std::string& command) {
  Outcome out = run_process(command + " 2>&1");
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
