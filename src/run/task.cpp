#include "run/task.hpp"

#include "checks/checks.hpp"
#include "checks/store.hpp"
#include "util/error.hpp"
#include "results/journal.hpp"
#include "util/file.hpp"
#include "results/annotate.hpp"
#include "results/writer.hpp"
#include "run/progress.hpp"
#include "run/provenance.hpp"
#include "run/signals.hpp"
#include "run/sweep.hpp"

#include <fmt/format.h>
#include <filesystem>
#include <fmt/ranges.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

namespace bristle {
namespace {

// Stores the verdicts beside the numbers that they follow from.
void add_checks(const std::string& path) {
  const auto checks = evaluate_checks(ResultReader(path));
  write_checks(path, checks);
}

// Rewrites title, notes and checks of a result whose numbers are up to date.
void refresh(const Task& task) {
  if (ResultReader(task.path, Expected::either).experiment() == *task.experiment.document) return;
  const Journal lock(task.path, kCommit, false);
  const std::string copy = task.path + ".partial";
  std::filesystem::copy_file(task.path, copy, std::filesystem::copy_options::overwrite_existing);
  annotate(copy, task.experiment, task.shard);
  if (!task.shard) add_checks(copy);
  replace_file(copy, task.path);
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

std::vector<std::size_t> missing_points(const Task& task, const Journal& journal) {
  std::vector<std::size_t> missing;
  for (const std::size_t i : task.points())
    if (!journal.has(point_key(task.experiment, i))) missing.push_back(i);
  return missing;
}

// Computes what the journal lacks, each point into it as it is done.
void fill_journal(const Task& task, const std::vector<std::size_t>& missing, int threads, Journal& journal,
                  bool quiet) {
  const Experiment& experiment = task.experiment;
  const std::size_t all = task.points().size();
  Progress progress(experiment.name, missing.size(), quiet);
  std::size_t saved = all - missing.size();
  const auto sink = [&](PointReport&& report) {
    journal.append(point_key(experiment, report.index), report.record);
    ++saved;
    progress.step();
  };
  std::string trouble;
  try {
    if (!run_sweep(experiment, missing, threads, sink, interrupted)) trouble = "interrupted";
    journal.sync();
  } catch (const RunError& e) {
    trouble = e.what();
  }
  progress.finish();
  if (!trouble.empty())
    throw RunError(fmt::format("{}; {} of {} points are saved in {}: the same command computes the rest",
                               trouble, saved, all, journal.path()));
}

// From the journal to the result, in the order of the points.
Tally write_result(const Task& task, const Journal& journal, std::map<std::string, std::string> record) {
  Tally tally;
  std::set<std::string> commits;
  ResultWriter writer(task.experiment, task.path, task.shard);
  for (const std::size_t i : task.points()) {
    const JournalLine line = journal.read(point_key(task.experiment, i));
    if (!fits(line.record, task.experiment))
      throw RunError(fmt::format("{}: has other variables than this program's results; --force computes anew",
                                 journal.path()));
    writer.write(i, line.record);
    tally.add(line.record);
    commits.insert(line.commit);
  }
  record["points_commits"] = fmt::format("{}", fmt::join(commits, ", "));
  record["finished"] = utc_now();
  writer.close(record);
  if (!task.shard) add_checks(writer.partial());
  writer.publish();
  return tally;
}

void compute(const Task& task, int threads, const TaskOptions& options) {
  end_tidily_on_signals();
  auto record = provenance(options.command_line, threads);
  record["started"] = utc_now();
  Journal journal(task.path, kCommit, options.force);
  std::vector<std::size_t> missing = missing_points(task, journal);
  if (!options.force && !missing.empty()) {
    journal.adopt(task.experiment, missing);
    missing = missing_points(task, journal);
  }
  const std::size_t all = task.points().size(), found = all - missing.size();
  record["points_computed"] = fmt::format("{} of {}", missing.size(), all);
  fill_journal(task, missing, threads, journal, options.quiet);
  const Tally tally = [&] {
    try {
      return write_result(task, journal, record);
    } catch (const RunError& e) {
      throw RunError(fmt::format("{}; all points are saved in {}: the same command writes the result",
                                 e.what(), journal.path()));
    }
  }();
  if (options.quiet) return;
  fmt::print("{}: points: {}{}\n", task.path, all > 0 ? tally.text() : "none in this shard",
             found > 0 ? fmt::format("; {} computed before", found) : std::string());
}

}  // namespace

std::vector<std::size_t> Task::points() const {
  return shard_points(shard.value_or(Shard{1, 1}), experiment.points());
}

void run_task(const Task& task, const TaskOptions& options) {
  if (!options.force && up_to_date(task.path, task.experiment, task.shard)) {
    refresh(task);
    if (!options.quiet)
      fmt::print("{} is up to date: nothing to compute (--force computes it anew)\n", task.path);
    return;
  }
  const int cores = int(std::max(1u, std::thread::hardware_concurrency()));
  compute(task, options.threads > 0 ? options.threads : cores, options);
}

}  // namespace bristle
