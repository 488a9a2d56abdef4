#include "util/git.hpp"

#include "util/error.hpp"
#include "util/process.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <sstream>

namespace bristle {
namespace {

std::string without_newline(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

}  // namespace

Repository::Repository(const std::string& folder, const std::string& option, const std::string& purpose)
    : folder_(folder), option_(option) {
  if (run_process("git --version 2>&1").code != 0)
    throw InputError(fmt::format("git is not installed; {}", purpose));
  const auto prefix =
      run_process(fmt::format("git -C {} rev-parse --show-prefix 2>&1", shell_quoted(folder_)));
  if (prefix.code != 0)
    throw InputError(
        fmt::format("{}: not in a git work tree: {}; {}", option_, without_newline(prefix.output), purpose));
  prefix_ = without_newline(prefix.output);
}

std::string Repository::git(const std::string& arguments) const {
  const std::string command = fmt::format("git -C {} {}", shell_quoted(folder_), arguments);
  const ProcessResult out = run_process(command);
  if (out.code != 0) throw InputError(fmt::format("{}: failed: {}", option_, command));
  return out.output;
}

std::string Repository::commit() const { return without_newline(git("rev-parse --verify HEAD")); }

std::time_t Repository::commit_time() const { return std::stol(git("show -s --format=%ct HEAD")); }

std::string Repository::changes(const std::string& except) const {
  const std::string others = except.empty() ? "" : " " + shell_quoted(":(exclude,literal)" + except);
  return git("status --porcelain --untracked-files=all -- :/" + others);
}

bool Repository::descends_from(const std::string& commit) const {
  return !commit.empty() && std::all_of(commit.begin(), commit.end(), ::isxdigit) &&
         run_process(fmt::format("git -C {} merge-base --is-ancestor {} HEAD 2>/dev/null",
                                 shell_quoted(folder_), commit))
                 .code == 0;
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
