#include "cli/command_line.hpp"

#include "bristle/simd/probe.hpp"
#include "cli/commands.hpp"
#include "cli/usage.hpp"
#include "run/provenance.hpp"
#include "util/error.hpp"
#include "util/text.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>
#include <map>

namespace bristle::cli {
namespace {

void add_tier(CLI::App& command, std::string& tier, const std::string& description) {
  command.add_option("--tier", tier, description)
      ->check(CLI::IsMember({"smoke", "study", "full"}))
      ->capture_default_str();
}

// Adds a command on an experiment.
CLI::App* add_experiment(CLI::App& app, const char* name, const char* description,
                         ExperimentOptions& options) {
  auto* command = app.add_subcommand(name, description);
  command->add_option("EXPERIMENT", options.file, "experiment file (JSON), or - for standard input")
      ->required();
  command
      ->add_option(
          "--set", options.load.set,
          "change a value: KEY=VALUE, or /json/pointer=VALUE where several blocks have the key (repeatable)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  add_tier(*command, options.load.tier,
           "smoke: a small subset of the points; study: the subset for `assumptions`; full: all");
  return command;
}

CLI::App* add_new(CLI::App& app, std::string& name, bool& in_si, bool& repository) {
  auto* command = app.add_subcommand("new", "write an experiment to start from");
  command
      ->add_option("NAME", name,
                   "its name: letters, digits, _ . -; written to experiments/NAME.json, or NAME.json")
      ->required();
  command->add_flag("--si", in_si, "of a material in SI units: friction over velocity");
  command->add_flag("--repository", repository,
                    "in a folder NAME, with a script and a workflow that check its numbers at every commit");
  return command;
}

CLI::App* add_run(CLI::App& app, ExperimentOptions& experiment, run::RunOptions& run,
                  std::string& instruction_set) {
  auto* command = add_experiment(app, "run", "compute an experiment into an HDF5 result file", experiment);
  command->get_option("EXPERIMENT")
      ->description(
          "experiment file (JSON), - for standard input, or a result file, for the experiment stored in it");
  command->add_option("-o,--output", run.output,
                      "result file, or - for standard output [results/<name>.h5 or, of another tier, "
                      "results/<name>-<tier>.h5]");
  auto* shard = command->add_option_function<std::string>(
      "--shard", [&run](const std::string& text) { run.shard = run::parse_shard(text); },
      "compute the i-th of N shares of the points into a journal beside the result");
  shard->type_name("i/N");
  command->add_option("--threads", run.threads, "threads [all cores]")->check(CLI::Range(1, 1024));
  command->add_option(
      "--instruction-set", instruction_set,
      "instruction set of the fast engine; does not change the numbers [the widest available]");
  auto* force = command->add_flag("--force", run.force, "compute even if the result is up to date");
  auto* point = command->add_option("--point", experiment.point,
                                    "compute only the point of this number, from 0, the last axis fastest");
  point->type_name("N")->excludes(shard)->check([](const std::string& text) {
    return std::string(text.starts_with('-') ? "the number of a point is 0 or more" : "");
  });
  command
      ->add_flag("--complete", run.complete,
                 "write the result of what shards have computed; name what is missing, and compute nothing")
      ->excludes(shard, force, point);
  command->add_flag("-q,--quiet", run.quiet, "no progress, no summary");
  return command;
}

CLI::App* add_design(CLI::App& app, ExperimentOptions& experiment, run::RunOptions& run) {
  auto* command = add_experiment(app, "design",
                                 "the same as `run`, of an experiment with a design: look for the best brush",
                                 experiment);
  command->add_option("-o,--output", run.output, "result file [as of `run`]");
  command->add_option("--threads", run.threads, "threads [all cores]")->check(CLI::Range(1, 1024));
  command->add_flag("--force", run.force, "compute even if the result is up to date");
  command->add_flag("-q,--quiet", run.quiet, "no progress, no summary");
  return command;
}

CLI::App* add_cite(CLI::App& app, std::string& result) {
  auto* command = app.add_subcommand("cite", "print BibTeX entries of the software, the paper and a result");
  command->add_option("FILE", result, "result file, to cite it, too");
  return command;
}

CLI::App* add_info(CLI::App& app, InfoOptions& info) {
  auto* command = app.add_subcommand("info", "print the contents and the provenance of a result file");
  command->add_option("FILE", info.file, "result file")->required();
  command->add_flag("--json", info.json, "print JSON");
  return command;
}

CLI::App* add_export(CLI::App& app, ExportOptions& options) {
  auto* command = app.add_subcommand("export", "write the numbers of a result as a table (CSV)");
  command->add_option("FILE", options.file, "result file")->required();
  command->add_option("-o,--output", options.output,
                      "table, or - for standard output [the name of FILE with .csv]");
  command->add_option("--group", options.group,
                      "checks, indices, jumps, load_error, quantiles, a group of a design such as drawing, "
                      "or a recorded table, in place of the variables");
  command->add_option("--only", options.only, "names of variables, separated by commas [all]")
      ->delimiter(',');
  command->add_option(
      "--checks", options.checks,
      "with --group checks: evaluate the checks of this file, such as an experiment, in place "
      "of the result's");
  return command;
}

CLI::App* add_value(CLI::App& app, ValueOptions& options) {
  auto* command = app.add_subcommand("value", "print variables of a result with their errors");
  command->add_option("FILE", options.file, "result file")->required();
  command->add_option("NAME", options.names, "names of variables")->required();
  command
      ->add_option("--at", options.at, "the value of an axis nearest to this one (repeatable) [all points]")
      ->type_name("AXIS=VALUE")
      ->allow_extra_args(false);
  command->add_flag("--json", options.json, "print JSON: a list of the points with their coordinates");
  return command;
}

CLI::App* add_check(CLI::App& app, CheckOptions& check) {
  auto* command = app.add_subcommand(
      "check", "compare a result with the claims of the paper and with its stored reference");
  command->add_option("FILE", check.file, "result file")->required();
  command->add_option("--reference", check.reference,
                      "folder of the references (default: reference, or the program's own)");
  command->add_flag("--report-only", check.report_only, "do not fail if a claim is not supported");
  command->add_flag("--claims-only", check.claims_only, "do not compare with the reference");
  command->add_flag("--all", check.all, "print further checks, too, which decide nothing");
  command->add_flag("--json", check.json,
                    "print JSON: the comparison, and for each point the command that computes it again");
  return command;
}

CLI::App* add_diff(CLI::App& app, DiffOptions& diff) {
  auto* command = app.add_subcommand("diff", "compare the numbers of two results");
  command->add_option("A", diff.a, "result file")->required();
  command->add_option("B", diff.b, "result file")->required();
  command->add_option("--rtol", diff.tolerances.rtol, "relative tolerance [none: any difference counts]");
  command->add_option("--atol", diff.tolerances.atol, "absolute tolerance");
  command
      ->add_option("--only", diff.only,
                   "names of variables, separated by commas: print their values in A and in B, point by "
                   "point [compare "
                   "everything]")
      ->delimiter(',');
  return command;
}

CLI::App* add_assumptions(CLI::App& app, assumptions::AssumptionsOptions& options) {
  auto* command = app.add_subcommand(
      "assumptions", "evaluate every claim under alternatives for the choices that the paper leaves open");
  command->add_option("FILES", options.files, "files of assumptions [all in <experiments>/assumptions]");
  command->add_option("--experiments", options.experiments, "folder of the experiments")
      ->capture_default_str();
  command->add_option("--only", options.only, "names of experiments [all with claims]")->delimiter(',');
  command
      ->add_option("-o,--output", options.output,
                   "file of the matrix; the results go to a folder of the same name")
      ->capture_default_str();
  add_tier(*command, options.tier, "tier of the experiments");
  command->add_option("--threads", options.threads, "threads [all cores]")->check(CLI::Range(1, 1024));
  command->add_flag("-q,--quiet", options.quiet, "no progress");
  return command;
}

CLI::App* add_reference_update(CLI::App& app, compare::ReferenceUpdate& update) {
  auto* reference = app.add_subcommand("reference", "the stored values that `check` compares with");
  reference->require_subcommand(1);
  auto* command = reference->add_subcommand(
      "update", "replace the reference by a result of the smoke tier and record the reason");
  command->add_option("FILE", update.file, "result file")->required();
  command->add_option("--reason", update.reason, "why the reference changes, one line")->required();
  command->add_option("--reference", update.folder, "folder of the references")->capture_default_str();
  return command;
}

CLI::App* add_archive(CLI::App& app, archive::ArchiveOptions& archive) {
  auto* command =
      app.add_subcommand("archive", "write the results of all figures and studies into one citable archive");
  command->add_option("-o,--output", archive.output, "archive [dist/bristle-<version>.tar]");
  command->add_option("--results", archive.results, "folder of the results")->capture_default_str();
  command->add_option("--figures", archive.figures, "folder of the figures")->capture_default_str();
  command->add_option("--report", archive.report, "the report")->capture_default_str();
  command->add_option("--source", archive.source, "source repository")->capture_default_str();
  add_tier(*command, archive.tier, "full; of another tier the archive is a draft, to try it");
  command->add_flag("--allow-dirty", archive.allow_dirty,
                    "archive results that cannot be traced to a commit, as a draft");
  command->add_flag(
      "--check", archive.check_only,
      "write nothing; only check what results, figures and pages that are still missing cannot change");
  return command;
}

CLI::App* add_verify(CLI::App& app, VerifyOptions& verify) {
  auto* command = app.add_subcommand("verify", "check the hashes, digests and metadata of an archive");
  command->add_option("ARCHIVE", verify.file, "archive")->required();
  command->add_option("--rerun", verify.rerun, "compute N points again and compare every bit")
      ->type_name("N");
  command->add_option("--seed", verify.seed, "seed for the choice of points")->capture_default_str();
  return command;
}

// Examples of each command, for its help.
const std::map<std::string, std::vector<std::string>> kExamples = {
    {"new", {"bristle new mine", "bristle new brush --si"}},
    {"run",
     {"bristle run experiments/fig4.json --tier smoke",
      "bristle run experiments/brush.json --set tau_f_Pa=5e7 -o results/strong.h5",
      "bristle run results/fig4.h5 --point 1200"}},
    {"design",
     {"bristle design experiments/design.json --tier smoke",
      "bristle design experiments/design.json --set /design/budget=200"}},
    {"validate", {"bristle validate experiments/brush.json"}},
    {"law", {"bristle law experiments/fig7.json >laws.csv"}},
    {"schema", {"bristle schema >experiment.schema.json"}},
    {"info", {"bristle info results/fig4.h5"}},
    {"export",
     {"bristle export results/brush.h5 --only friction_coefficient,R_x_in_N",
      "bristle export results/design.h5 --group drawing -o -"}},
    {"value", {"bristle value results/fig4.h5 R_x_norm --at k_r=20 --at k_theta=1 --at bending=rod"}},
    {"check", {"bristle check results/fig4.h5 --report-only"}},
    {"diff",
     {"bristle diff results/fig4.h5 results/half.h5 --rtol 1e-3",
      "bristle diff results/a.h5 results/b.h5 --only R_x_norm"}},
    {"cite", {"bristle cite results/fig4.h5 >>references.bib"}},
    {"archive", {"bristle archive --check", "bristle archive --tier smoke"}},
    {"verify", {"bristle verify dist/bristle-0.2.0.tar --rerun 3"}},
    {"assumptions", {"bristle assumptions --only fig7 --tier smoke -o results/fig7-smoke.json"}},
    {"update", {"bristle reference update results/brush-smoke.h5 --reason 'first values'"}},
};

// Defines the subcommands. Each stores its options here, and its callback selects the function to run.
class CommandLine {
 public:
  CommandLine(int argc, char** argv) {
    run_.arguments = assumptions_.arguments = {argv, argv + argc};
    app_.set_version_flag("--version", fmt::format("bristle {} ({})", run::kVersion, run::kCommit));
    app_.require_subcommand(1);
    app_.footer(
        "Exit codes: 0 success; 1 a check failed; 2 wrong input or command line; "
        "3 the run could not finish; 130 interrupted (Ctrl-C).");
    set_action(add_new(app_, new_name_, new_in_si_, new_repository_), [this] {
      return new_command(run_.arguments.front(), new_name_, new_in_si_, new_repository_);
    });
    set_action(add_run(app_, experiment_, run_, instruction_set_),
               computing([this] { return run_command(experiment_, run_, instruction_set_); }));
    set_action(add_design(app_, experiment_, run_),
               computing([this] { return run_command(experiment_, run_, "", true); }));
    set_action(add_experiment(app_, "validate", "check an experiment file without computing it", experiment_),
               computing([this] { return validate_command(experiment_); }));
    set_action(
        add_experiment(app_, "law", "print the friction laws of an experiment over the sliding speed (CSV)",
                       experiment_),
        computing([this] { return law_command(experiment_); }));
    set_action(app_.add_subcommand("schema", "print the JSON schema of experiment files, for editors"),
               [] { return schema_command(); });
    set_action(add_info(app_, info_), [this] { return info_command(info_); });
    set_action(add_export(app_, export_), [this] { return export_command(export_); });
    set_action(add_value(app_, value_), [this] { return value_command(value_); });
    set_action(add_check(app_, check_), computing([this] { return check_command(check_); }));
    set_action(add_diff(app_, diff_), computing([this] { return diff_command(diff_); }));
    set_action(add_cite(app_, cited_), [this] { return cite_command(cited_); });
    set_action(add_archive(app_, archive_), [this] { return archive_command(archive_); });
    set_action(add_verify(app_, verify_), [this] {
      if (verify_.rerun > 0) require_same_bits();
      return verify_command(verify_);
    });
    set_action(add_assumptions(app_, assumptions_),
               computing([this] { return assumptions_command(assumptions_); }));
    set_action(add_reference_update(app_, update_),
               computing([this] { return reference_update_command(update_); }));
  }

  // Runs the selected command; returns the exit code.
  int dispatch(int argc, char** argv) {
    if (argc == 1) {
      write_message(fmt::format("{}\n\n{}", app_.get_description(), first_steps()));
      return kBadInput;
    }
    try {
      app_.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
      if (e.get_exit_code() != int(CLI::ExitCodes::Success))
        throw InputError(command_line_mistake(app_, e.what()));
      return app_.exit(e);  // prints help or version
    }
    return selected_();
  }

 private:
  using Command = std::function<int()>;

  // Returns a command that calls require_same_bits() before `command`, which computes numbers or judges them.
  static Command computing(Command command) {
    return [command = std::move(command)] {
      require_same_bits();
      return command();
    };
  }

  void set_action(CLI::App* subcommand, Command command) {
    subcommand->callback([this, command = std::move(command)] { selected_ = command; });
    const std::string examples =
        fmt::format("Examples:\n  {}", fmt::join(kExamples.at(subcommand->get_name()), "\n  "));
    subcommand->footer(examples);
    if (CLI::App* parent = subcommand->get_parent(); parent != &app_) parent->footer(examples);
  }

  CLI::App app_{"bristle: dry friction of a lattice of elastic bristles under a sliding slab"};
  Command selected_;
  std::string new_name_, instruction_set_, cited_;
  bool new_in_si_ = false, new_repository_ = false;
  ExperimentOptions experiment_;
  run::RunOptions run_;
  InfoOptions info_;
  ExportOptions export_;
  ValueOptions value_;
  CheckOptions check_;
  DiffOptions diff_;
  archive::ArchiveOptions archive_;
  VerifyOptions verify_;
  assumptions::AssumptionsOptions assumptions_;
  compare::ReferenceUpdate update_;
};

}  // namespace

int run_command_line(int argc, char** argv) { return CommandLine(argc, argv).dispatch(argc, argv); }

}  // namespace bristle::cli
