#pragma once

#include "archive/build.hpp"
#include "assumptions/assumptions.hpp"
#include "checks/diff.hpp"
#include "checks/reference_update.hpp"

#include <optional>
#include <string>
#include <vector>

// One function per command of `bristle`; each returns the exit code and throws InputError or RunError.
namespace bristle {

enum ExitCode {
  kFine = 0,
  kCheckFailed = 1,
  kBadInput = 2,
  kCouldNotFinish = 3
};

struct RunOptions {
  std::string experiment, output;  // empty output: results/<name>.h5
  std::vector<std::string> set;
  std::string tier = "full";
  std::optional<std::string> shard;  // "i/N"; none: the whole
  int threads = 0;                   // 0: all cores
  std::string instruction_set;       // empty: the widest
  bool force = false, quiet = false;
  std::string command_line;
};

int run_command(const RunOptions& options);
int validate_command(const RunOptions& options);
int info_command(const std::string& file);

struct CheckOptions {
  std::string file, reference = "reference";
  bool report_only = false;  // claims that are not supported do not fail
  bool claims_only = false;  // no comparison with the reference
  bool json = false;         // for programs: deviations, and the command that computes each point again
};
int check_command(const CheckOptions& options);

struct DiffOptions {
  std::string a, b;
  Tolerances tolerances;
};
int diff_command(const DiffOptions& options);

struct MergeOptions {
  std::vector<std::string> parts;
  std::string output, command_line;
};
int merge_command(const MergeOptions& options);

int assumptions_command(AssumptionsOptions options);

int reference_update_command(ReferenceUpdate update);

int archive_command(ArchiveOptions options);

struct VerifyOptions {
  std::string file;
  std::size_t rerun = 0;   // points to compute again
  std::uint64_t seed = 1;  // decides which
};
int verify_command(const VerifyOptions& options);

}  // namespace bristle
