#include "archive/verify.hpp"
#include "cli/commands.hpp"
#include "run/provenance.hpp"

#include <fmt/format.h>

namespace bristle {
namespace {

// A damaged manifest makes one problem per file.
constexpr std::size_t kMostShown = 20;

void print_problems(const std::string& path, const Problems& problems) {
  for (std::size_t i = 0; i < std::min(kMostShown, problems.size()); ++i)
    fmt::print("FAILED: {}\n", problems[i]);
  if (problems.size() > kMostShown) fmt::print("... and {} more\n", problems.size() - kMostShown);
  fmt::print("{}: NOT as it was archived: {} problem{}\n", path, problems.size(),
             problems.size() == 1 ? "" : "s");
}

}  // namespace

int archive_command(ArchiveOptions options) {
  options.version = kVersion;
  options.commit = kCommit;
  const BuiltArchive built = build_archive(options);
  fmt::print("{}: {} files, {} bytes, verified\nsha512 {}\n", built.path, built.files, built.bytes,
             built.sha512);
  if (!built.draft.empty()) fmt::print("a draft, not to be cited: {}\n", built.draft);
  return kFine;
}

int verify_command(const VerifyOptions& options) {
  const Verification found = verify_archive(options.file);
  if (!found.problems.empty()) {
    print_problems(options.file, found.problems);
    return kCheckFailed;
  }
  fmt::print("{}: version {} of commit {}\n{} files and {} results are as they were archived ({})\n",
             options.file, found.version, found.commit, found.files, found.results, found.identifier);
  if (!found.draft.empty()) fmt::print("a draft, not to be cited: {}\n", found.draft);
  return kFine;
}

}  // namespace bristle
