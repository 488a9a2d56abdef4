#include "cli/commands.hpp"
#include "experiment/input_error.hpp"
#include "results/hdf5.hpp"
#include "run/provenance.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace {

using namespace bristle;

void add_experiment(CLI::App& command, RunOptions& options) {
  command.add_option("EXPERIMENT", options.experiment, "experiment file (JSON)")->required();
  command.add_option("--set", options.set, "change a value: /json/pointer=value (repeatable)")
      ->type_name("PTR=VALUE")
      ->allow_extra_args(false);
  command.add_option("--tier", options.tier, "smoke: the experiment's small subset; full: all of it")
      ->check(CLI::IsMember({"smoke", "full"}))
      ->capture_default_str();
}

int dispatch(int argc, char** argv) {
  CLI::App app{"bristle: dry friction of a lattice of elastic bristles under a sliding slab"};
  app.set_version_flag("--version", fmt::format("bristle {} ({})", kVersion, kCommit));
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 fine; 1 a check failed; 2 wrong input or command line; 3 the run could not finish.");

  RunOptions run;
  for (int i = 0; i < argc; ++i) run.command_line += fmt::format("{}{}", i ? " " : "", argv[i]);
  auto* run_app = app.add_subcommand("run", "compute an experiment into an HDF5 result file");
  add_experiment(*run_app, run);
  run_app->add_option("-o,--output", run.output, "result file [results/<name>.h5]");
  run_app->add_option("--threads", run.threads, "threads [all cores]")->check(CLI::Range(1, 1024));
  run_app->add_flag("--force", run.force, "compute even if the result is up to date");
  run_app->add_flag("--quiet", run.quiet, "no progress, no summary");

  auto* validate_app = app.add_subcommand("validate", "check an experiment file, compute nothing");
  add_experiment(*validate_app, run);

  std::string info_file;
  auto* info_app = app.add_subcommand("info", "what a result file holds and where it is from");
  info_app->add_option("FILE", info_file, "result file")->required();

  CheckOptions check;
  auto* check_app = app.add_subcommand("check", "compare a result with the claims in its experiment");
  check_app->add_option("FILE", check.file, "result file")->required();
  check_app->add_flag("--report-only", check.report_only, "exit 0 even if a claim is not supported");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? kFine : kBadInput;
  }
  if (*run_app) return run_command(run);
  if (*validate_app) return validate_command(run);
  if (*info_app) return info_command(info_file);
  return check_command(check);
}

}  // namespace

int main(int argc, char** argv) {
  h5::silence();
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
