#include "checks/checks.hpp"
#include "cli/commands.hpp"
#include "experiment/experiment.hpp"
#include "experiment/input_error.hpp"
#include "results/variables.hpp"
#include "results/writer.hpp"
#include "run/progress.hpp"
#include "run/provenance.hpp"
#include "run/sweep.hpp"

#include <fmt/format.h>
#include <csignal>
#include <filesystem>
#include <thread>

namespace bristle {
namespace {

volatile std::sig_atomic_t interrupted = 0;
void on_interrupt(int) { interrupted = 1; }

// Stores the verdicts beside the numbers that they follow from.
void add_checks(const std::string& path) {
  const auto checks = evaluate_checks(ResultReader(path));
  write_checks(path, checks);
}

// The numbers are there; what describes them has changed.
void refresh(const std::string& path, const Experiment& experiment) {
  if (ResultReader(path).experiment() == experiment.document) return;
  const std::string copy = path + ".refresh";
  std::filesystem::copy_file(path, copy, std::filesystem::copy_options::overwrite_existing);
  annotate(copy, experiment);
  add_checks(copy);
  std::filesystem::rename(copy, path);
}

// Counts of the points' statuses, for the closing line.
class Tally {
 public:
  void add(PointStatus status) { ++counts_[std::size_t(status)]; }
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

void compute(const Experiment& experiment, const std::string& path, int threads, const RunOptions& options) {
  ResultWriter writer(experiment, path);
  Progress progress(experiment.name, experiment.points(), options.quiet);
  Tally tally;
  auto record = provenance(options.command_line, threads);
  record["started"] = utc_now();
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  const auto sink = [&](PointReport&& report) {
    if (experiment.base.loading.trace) {
      writer.write_curve(report.index, report.curve);
      for (const CurveNode& node : report.curve) tally.add(node.result.status);
    } else {
      writer.write_point(report.index, report.result, report.recorded);
      tally.add(report.result.status);
    }
    progress.step();
  };
  const bool complete = run_sweep(experiment, threads, sink, [] { return interrupted != 0; });
  progress.finish();
  if (!complete) throw RunError(fmt::format("interrupted; nothing was saved and {} is as it was", path));
  record["finished"] = utc_now();
  writer.close(record);
  add_checks(writer.partial());
  writer.publish();
  if (!options.quiet) fmt::print("{}: points: {}\n", path, tally.text());
}

Experiment load_checked(const RunOptions& options) {
  Experiment experiment = load_experiment(options.experiment, {options.set, options.tier});
  validate_checks(experiment);
  return experiment;
}

}  // namespace

int run_command(const RunOptions& options) {
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
