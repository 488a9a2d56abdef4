#include "checks/checks.hpp"
#include "cli/commands.hpp"
#include "dynamics/lanes/kernels.hpp"
#include "experiment/experiment.hpp"
#include "experiment/input_error.hpp"
#include "results/journal.hpp"
#include "results/writer.hpp"
#include "run/progress.hpp"
#include "run/provenance.hpp"
#include "run/sweep.hpp"

#include <fmt/format.h>
#include <csignal>
#include <filesystem>
#include <fmt/ranges.h>
#include <map>
#include <set>
#include <thread>

namespace bristle {
namespace {

volatile std::sig_atomic_t interrupted = 0;
// The first asks for an end, the second ends.
void on_interrupt(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

void end_tidily_on_signals() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  if (std::signal(SIGHUP, on_interrupt) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
}

// Stores the verdicts beside the numbers that they follow from.
void add_checks(const std::string& path) {
  const auto checks = evaluate_checks(ResultReader(path));
  write_checks(path, checks);
}

// The numbers are there; what describes them has changed.
void refresh(const std::string& path, const Experiment& experiment) {
  if (ResultReader(path).experiment() == experiment.document) return;
  const Journal others_stay_off(path, kCommit, false);
  const std::string copy = path + ".partial";
  std::filesystem::copy_file(path, copy, std::filesystem::copy_options::overwrite_existing);
  annotate(copy, experiment);
  add_checks(copy);
  std::filesystem::rename(copy, path);
}

// Counts of the points' statuses, for the closing line.
class Tally {
 public:
  void add(const PointRecord& record) {
    for (const double status : record.values.at("status")) ++counts_[std::size_t(status)];
  }
  std::string text() const {
    std::string out;
    for (std::size_t i = 0; i < counts_.size(); ++i)
      if (counts_[i] > 0)
        out += fmt::format("{}{} {}", out.empty() ? "" : ", ", counts_[i], kPointStatusNames[i]);
    return out;
  }

 private:
  std::vector<long> counts_ = std::vector<long>(kPointStatusNames.size(), 0);
};

std::vector<std::size_t> missing_points(const Experiment& experiment, const Journal& journal) {
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < experiment.points(); ++i)
    if (!journal.has(point_key(experiment, i))) missing.push_back(i);
  return missing;
}

// Computes what the journal lacks, each point into it as it is done.
void fill_journal(const Experiment& experiment, const std::vector<std::size_t>& missing, int threads,
                  Journal& journal, bool quiet) {
  Progress progress(experiment.name, missing.size(), quiet);
  std::size_t saved = experiment.points() - missing.size();
  const auto sink = [&](PointReport&& report) {
    journal.append(point_key(experiment, report.index), report.record);
    ++saved;
    progress.step();
  };
  std::string trouble;
  try {
    if (!run_sweep(experiment, missing, threads, sink, [] { return interrupted != 0; }))
      trouble = "interrupted";
    journal.sync();
  } catch (const RunError& e) {
    trouble = e.what();
  }
  progress.finish();
  if (!trouble.empty())
    throw RunError(fmt::format("{}; {} of {} points are saved in {}: the same command computes the rest",
                               trouble, saved, experiment.points(), journal.path()));
}

// From the journal to the result, in the order of the points.
Tally write_result(const Experiment& experiment, const std::string& path, const Journal& journal,
                   std::map<std::string, std::string> record) {
  Tally tally;
  std::set<std::string> commits;
  ResultWriter writer(experiment, path);
  for (std::size_t i = 0; i < experiment.points(); ++i) {
    const JournalLine line = journal.read(point_key(experiment, i));
    writer.write(i, line.record);
    tally.add(line.record);
    commits.insert(line.commit);
  }
  record["points_commits"] = fmt::format("{}", fmt::join(commits, ", "));
  record["finished"] = utc_now();
  writer.close(record);
  add_checks(writer.partial());
  writer.publish();
  return tally;
}

void compute(const Experiment& experiment, const std::string& path, int threads, const RunOptions& options) {
  end_tidily_on_signals();
  auto record = provenance(options.command_line, threads);
  record["started"] = utc_now();
  Journal journal(path, kCommit, options.force);
  std::vector<std::size_t> missing = missing_points(experiment, journal);
  if (!options.force && !missing.empty()) {
    journal.adopt(experiment, missing);
    missing = missing_points(experiment, journal);
  }
  const std::size_t found = experiment.points() - missing.size();
  record["points_computed"] = fmt::format("{} of {}", missing.size(), experiment.points());
  fill_journal(experiment, missing, threads, journal, options.quiet);
  const Tally tally = write_result(experiment, path, journal, record);
  if (options.quiet) return;
  fmt::print("{}: points: {}{}\n", path, tally.text(),
             found > 0 ? fmt::format("; {} computed before", found) : std::string());
}

void choose_instruction_set(const std::string& name) {
  if (name.empty() || prefer_kernels(name)) return;
  std::vector<std::string> names;
  for (const Kernels* kernels : available_kernels()) names.push_back(kernels->target);
  throw InputError(fmt::format("--instruction-set {}: not of this processor; allowed: {}", name,
                               names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

Experiment load_checked(const RunOptions& options) {
  Experiment experiment = load_experiment(options.experiment, {options.set, options.tier});
  validate_checks(experiment);
  return experiment;
}

}  // namespace

int run_command(const RunOptions& options) {
  choose_instruction_set(options.instruction_set);
  const Experiment experiment = load_checked(options);
  const std::string path =
      options.output.empty() ? fmt::format("results/{}.h5", experiment.name) : options.output;
  if (!options.force && up_to_date(path, experiment)) {
    refresh(path, experiment);
    if (!options.quiet) fmt::print("{} is up to date: nothing to compute (--force computes it anew)\n", path);
    return kFine;
  }
  const int cores = int(std::max(1u, std::thread::hardware_concurrency()));
  compute(experiment, path, options.threads > 0 ? options.threads : cores, options);
  return kFine;
}

int validate_command(const RunOptions& options) {
  const Experiment e = load_checked(options);
  std::string sweep;
  for (const Axis& axis : e.axes)
    sweep += fmt::format("{}{} ({} from {:.6g} to {:.6g})", sweep.empty() ? "" : " x ", axis.name,
                         axis.values.size(), axis.values.front(), axis.values.back());
  fmt::print("{}: fine. {}: {} point{}{}{}, {} check{}\n", options.experiment, e.name, e.points(),
             e.points() == 1 ? "" : "s", sweep.empty() ? "" : ", ", sweep, e.checks.size(),
             e.checks.size() == 1 ? "" : "s");
  return kFine;
}

}  // namespace bristle
