#include "cli/commands.hpp"
#include "util/error.hpp"
#include "util/text.hpp"
#include "results/hdf5.hpp"
#include "run/provenance.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <csignal>

namespace {

using namespace bristle;

void add_experiment(CLI::App& command, RunOptions& options) {
  command.add_option("EXPERIMENT", options.experiment, "experiment file (JSON)")->required();
  command.add_option("--set", options.set, "change a value: /json/pointer=value (repeatable)")
      ->type_name("PTR=VALUE")
      ->allow_extra_args(false);
  command
      .add_option("--tier", options.tier,
                  "smoke: the experiment's small subset; study: that of `assumptions`; full: all of it")
      ->check(CLI::IsMember({"smoke", "study", "full"}))
      ->capture_default_str();
}

CLI::App* add_run(CLI::App& app, RunOptions& run) {
  auto* command = app.add_subcommand("run", "compute an experiment into an HDF5 result file");
  add_experiment(*command, run);
  command->add_option("-o,--output", run.output, "result file [results/<name>.h5]");
  command->add_option("--shard", run.shard, "compute the i-th of N parts, for `bristle merge`")
      ->type_name("i/N");
  command->add_option("--threads", run.threads, "threads [all cores]")->check(CLI::Range(1, 1024));
  command->add_option("--instruction-set", run.instruction_set,
                      "of the fast engine, the numbers are the same [the widest that the processor has]");
  command->add_flag("--force", run.force, "compute even if the result is up to date");
  command->add_flag("--quiet", run.quiet, "no progress, no summary");
  return command;
}

CLI::App* add_check(CLI::App& app, CheckOptions& check) {
  auto* command = app.add_subcommand("check", "hold a result against its claims and its stored reference");
  command->add_option("FILE", check.file, "result file")->required();
  command->add_option("--reference", check.reference, "folder of the references")->capture_default_str();
  command->add_flag("--report-only", check.report_only, "a claim that is not supported is no failure");
  command->add_flag("--claims-only", check.claims_only, "no comparison with the reference");
  command->add_flag("--json", check.json,
                    "for programs: the comparison, and for each point the command that computes it again");
  return command;
}

CLI::App* add_diff(CLI::App& app, DiffOptions& diff) {
  auto* command = app.add_subcommand("diff", "compare the numbers of two results");
  command->add_option("A", diff.a, "result file")->required();
  command->add_option("B", diff.b, "result file")->required();
  command->add_option("--rtol", diff.tolerances.rtol, "relative tolerance [none: any difference counts]");
  command->add_option("--atol", diff.tolerances.atol, "absolute tolerance");
  return command;
}

CLI::App* add_merge(CLI::App& app, MergeOptions& merge) {
  auto* command = app.add_subcommand("merge", "make one result of the parts of a sharded run");
  command->add_option("-o,--output", merge.output, "result file")->required();
  command->add_option("PARTS", merge.parts, "what `bristle run --shard i/N` wrote, all N, in any order")
      ->required();
  return command;
}

CLI::App* add_assumptions(CLI::App& app, AssumptionsOptions& options) {
  auto* command =
      app.add_subcommand("assumptions", "every claim under every alternative to what the paper leaves open");
  command->add_option("FILES", options.files, "assumptions [all of <experiments>/assumptions]");
  command->add_option("--experiments", options.experiments, "folder of the experiments")->capture_default_str();
  command->add_option("-o,--output", options.output, "matrix; the runs' results go into a folder beside it")
      ->capture_default_str();
  command->add_option("--tier", options.tier, "of the experiments")
      ->check(CLI::IsMember({"smoke", "study", "full"}))
      ->capture_default_str();
  command->add_option("--threads", options.threads, "threads [all cores]")->check(CLI::Range(1, 1024));
  command->add_flag("-q,--quiet", options.quiet, "no progress");
  return command;
}

void add_reference_update(CLI::App& app, ReferenceUpdate& update) {
  auto* reference = app.add_subcommand("reference", "the stored values that `check` compares with");
  reference->require_subcommand(1);
  auto* command = reference->add_subcommand("update", "make a smoke tier's result the reference, on record");
  command->add_option("FILE", update.file, "result file")->required();
  command->add_option("--reason", update.reason, "why the reference changes, one line")->required();
  command->add_option("--reference", update.folder, "folder of the references")->capture_default_str();
}

CLI::App* add_archive(CLI::App& app, ArchiveOptions& archive) {
  auto* command = app.add_subcommand("archive", "one citable file of all figures' results");
  command->add_option("-o,--output", archive.output, "archive [dist/bristle-<version>.tar]");
  command->add_option("--results", archive.results, "folder of the results")->capture_default_str();
  command->add_option("--figures", archive.figures, "folder of the figures")->capture_default_str();
  command->add_option("--source", archive.source, "the repository they are of")->capture_default_str();
  command->add_flag("--allow-dirty", archive.allow_dirty,
                    "a draft of what cannot be traced to a commit, on record in it");
  return command;
}

CLI::App* add_verify(CLI::App& app, VerifyOptions& verify) {
  auto* command = app.add_subcommand("verify", "hold an archive against its hashes, digests and metadata");
  command->add_option("ARCHIVE", verify.file, "archive")->required();
  command->add_option("--rerun", verify.rerun, "compute so many points again and compare every bit")
      ->type_name("N");
  command->add_option("--seed", verify.seed, "decides which points")->capture_default_str();
  return command;
}

int dispatch(int argc, char** argv) {
  CLI::App app{"bristle: dry friction of a lattice of elastic bristles under a sliding slab"};
  app.set_version_flag("--version", fmt::format("bristle {} ({})", kVersion, kCommit));
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 fine; 1 a check failed; 2 wrong input or command line; 3 the run could not finish.");

  RunOptions run;
  for (int i = 0; i < argc; ++i) run.command_line += fmt::format("{}{}", i ? " " : "", shell_quoted(argv[i]));
  auto* run_app = add_run(app, run);
  auto* validate_app = app.add_subcommand("validate", "check an experiment file, compute nothing");
  add_experiment(*validate_app, run);

  std::string info_file;
  auto* info_app = app.add_subcommand("info", "what a result file holds and where it is from");
  info_app->add_option("FILE", info_file, "result file")->required();

  MergeOptions merge;
  merge.command_line = run.command_line;
  CheckOptions check;
  DiffOptions diff;
  ReferenceUpdate update;
  auto* check_app = add_check(app, check);
  auto* diff_app = add_diff(app, diff);
  auto* merge_app = add_merge(app, merge);
  ArchiveOptions archive;
  VerifyOptions verify;
  auto* archive_app = add_archive(app, archive);
  auto* verify_app = add_verify(app, verify);
  AssumptionsOptions assumptions;
  assumptions.command_line = run.command_line;
  auto* assumptions_app = add_assumptions(app, assumptions);
  add_reference_update(app, update);  // the last that is left

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? kFine : kBadInput;
  }
  if (*run_app) return run_command(run);
  if (*validate_app) return validate_command(run);
  if (*info_app) return info_command(info_file);
  if (*check_app) return check_command(check);
  if (*diff_app) return diff_command(diff);
  if (*merge_app) return merge_command(merge);
  if (*archive_app) return archive_command(archive);
  if (*verify_app) return verify_command(verify);
  if (*assumptions_app) return assumptions_command(assumptions);
  return reference_update_command(update);
}

}  // namespace

int main(int argc, char** argv) {
  h5::silence();
  std::signal(SIGXFSZ, SIG_IGN);  // a file-size limit is an error of the write, with a message
  try {
    return dispatch(argc, argv);
  } catch (const InputError& e) {
    fmt::print(stderr, "bristle: {}\n", e.what());
    return kBadInput;
  } catch (const std::exception& e) {
    fmt::print(stderr, "bristle: {}\n", e.what());
    return kCouldNotFinish;
  }
}
