#include "util/git.hpp"

#include "util/error.hpp"
#include "util/process.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <sstream>

namespace bristle {
namespace {

std::string without_newline(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

// Command for git without the variables by which the caller's shell, or a hook that runs the program, points
// git at another repository or changes what a path means.
constexpr const char* kGit =
    "env -u GIT_DIR -u GIT_WORK_TREE -u GIT_INDEX_FILE -u GIT_COMMON_DIR -u GIT_OBJECT_DIRECTORY "
    "-u GIT_ALTERNATE_OBJECT_DIRECTORIES -u GIT_NAMESPACE -u GIT_PREFIX -u GIT_GRAFT_FILE -u "
    "GIT_SHALLOW_FILE "
    "-u GIT_LITERAL_PATHSPECS -u GIT_GLOB_PATHSPECS -u GIT_NOGLOB_PATHSPECS -u GIT_ICASE_PATHSPECS git";

ProcessResult run_git(const std::string& folder, const std::string& arguments) {
  return run_process(fmt::format("{} -C {} {}", kGit, shell_quoted(folder), arguments));
}

}  // namespace

Repository::Repository(const std::string& folder, const std::string& option, const std::string& purpose)
    : folder_(folder), option_(option) {
  if (run_process("git --version 2>&1").code != 0)
    throw InputError(fmt::format("git is not installed; {}", purpose));
  const ProcessResult top = run_git(folder_, "rev-parse --show-toplevel 2>&1");
  if (top.code != 0)
    throw InputError(
        fmt::format("{}: not in a git work tree: {}; {}", option_, without_newline(top.output), purpose));
  top_ = without_newline(top.output);
  if (!is_top() && run_git(folder_, "check-ignore -q .").code == 0)
    throw InputError(fmt::format("{}: not in a git work tree: the repository {} above it ignores it; {}",
                                 option_, top_, purpose));
}

std::string Repository::git(const std::string& arguments) const {
  const ProcessResult out = run_git(folder_, arguments);
  if (out.code != 0)
    throw InputError(fmt::format("{}: failed: git -C {} {}", option_, shell_quoted(folder_), arguments));
  return out.output;
}

bool Repository::is_top() const {
  std::error_code ignored;
  return std::filesystem::equivalent(folder_, top_, ignored);
}

std::string Repository::commit() const { return without_newline(git("rev-parse --verify HEAD")); }

std::time_t Repository::commit_time() const {
  return std::stol(git("show -s --no-show-signature --format=%ct HEAD"));
}

std::string Repository::changes(const std::string& except) const {
  const std::string others = except.empty() ? "" : " " + shell_quoted(":(exclude,literal)" + except);
  return git("status --porcelain --untracked-files=all -- :/" + others);
}

bool Repository::descends_from(const std::string& commit) const {
  return !commit.empty() && std::all_of(commit.begin(), commit.end(), ::isxdigit) &&
         run_git(folder_, fmt::format("merge-base --is-ancestor {} HEAD 2>/dev/null", commit)).code == 0;
}

std::vector<std::string> Repository::files(const std::string& under) const {
  std::istringstream in(git("ls-files -z -- " + shell_quoted(under)));
  std::vector<std::string> names;
  for (std::string name; std::getline(in, name, '\0');) names.push_back(name);
  return names;
}

std::string Repository::source_archive(const std::string& prefix) const {
  return git(fmt::format("-c tar.umask=0022 archive --format=tar --prefix={} HEAD", shell_quoted(prefix)));
}

}  // namespace bristle
