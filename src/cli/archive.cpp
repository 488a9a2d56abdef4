#include "cli/commands.hpp"

#include "archive/build.hpp"
#include "archive/rerun.hpp"
#include "run/provenance.hpp"
#include "util/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace bristle::cli {
namespace {

// A damaged manifest causes one problem per file.
constexpr std::size_t kMaxShown = 20;

void print_problems(const std::string& path, const archive::Problems& problems) {
  for (std::size_t i = 0; i < std::min(kMaxShown, problems.size()); ++i)
    fmt::print("FAILED: {}\n", problems[i]);
  if (problems.size() > kMaxShown) fmt::print("... and {} more\n", problems.size() - kMaxShown);
  fmt::print("{}: NOT as it was archived: {} problem{}\n", path, problems.size(),
             problems.size() == 1 ? "" : "s");
}

void print_draft(const std::string& draft) {
  if (!draft.empty()) fmt::print("a draft, not to be cited: {}\n", draft);
}

// Computes points again; returns whether all have the numbers of the archive.
bool rerun_points(const VerifyOptions& options, const archive::Verification& archive) {
  std::size_t done = 0, same = 0;
  try {
    archive::rerun(archive, options.rerun, options.seed, [&](const archive::Rerun& point) {
      ++done;
      same += point.different.empty();
      const std::string verdict = point.different.empty()
                                      ? "the same, bit for bit"
                                      : fmt::format("DIFFERS in {}", fmt::join(point.different, ", "));
      fmt::print("{}: {}: {}\n", point.file, point.place, verdict);
      std::fflush(stdout);  // a point may take minutes
    });
  } catch (const MalformedError& e) {
    fmt::print("FAILED: {}\n", e.what());
    return false;
  }
  fmt::print("{} of {} points computed again are the same, bit for bit (seed {})\n", same, done,
             options.seed);
  return same == done;
}

}  // namespace

int archive_command(archive::ArchiveOptions options) {
  options.version = run::kVersion;
  options.commit = run::kCommit;
  if (options.check_only) {
    archive::check_before_archive(options);
    return kSuccess;
  }
  const archive::BuiltArchive built = archive::build_archive(options);
  fmt::print("{}: {} files, {} bytes, verified\nsha512 {}\n", built.path, built.files, built.bytes,
             built.sha512);
  print_draft(built.draft);
  return kSuccess;
}

int verify_command(const VerifyOptions& options) {
  const archive::Verification found = archive::verify_archive(options.file);
  if (!found.problems.empty()) {
    print_problems(options.file, found.problems);
    return kCheckFailed;
  }
  fmt::print("{}: version {} of commit {}\n{} files and {} results are as they were archived ({})\n",
             options.file, found.version, found.commit, found.files, found.results.size(), found.identifier);
  print_draft(found.draft);
  return options.rerun == 0 || rerun_points(options, found) ? kSuccess : kCheckFailed;
}

}  // namespace bristle::cli
