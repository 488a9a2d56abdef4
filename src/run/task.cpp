#include "run/task.hpp"

#include "claims/checks.hpp"
#include "claims/store.hpp"
#include "results/annotate.hpp"
#include "results/journal.hpp"
#include "results/writer.hpp"
#include "run/jumps.hpp"
#include "run/progress.hpp"
#include "run/provenance.hpp"
#include "run/signals.hpp"
#include "run/summary.hpp"
#include "run/sweep.hpp"
#include "util/error.hpp"
#include "util/file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace bristle::run {
namespace {

// Evaluates the checks of the result file and stores their verdicts in it.
void add_checks(const std::string& path) {
  const auto checks = claims::evaluate_checks(results::ResultReader(path));
  claims::write_checks(path, checks);
}

// Updates title, notes and checks of a result whose numbers are up to date.
void refresh_description(const Task& task) {
  if (results::ResultReader(task.path, results::Expected::either).experiment() == *task.experiment.document)
    return;
  const results::Journal lock(task.path, kCommit, false);
  WholeFile copy(task.path, results::replaceable_by(task.shard));
  const std::string bytes = read_file(task.path);
  copy.write(bytes.data(), bytes.size());
  copy.close();
  results::annotate(copy.partial(), task.experiment, task.shard);
  if (!task.shard) add_checks(copy.partial());
  copy.publish();
}

// Points of an experiment and their keys in journals.
class KeyedPoints {
 public:
  explicit KeyedPoints(const Task& task) : KeyedPoints(task.experiment, task.points()) {}
  // points: ascending
  KeyedPoints(const Experiment& experiment, std::vector<std::size_t> points) : points_(std::move(points)) {
    for (const std::size_t i : points_) keys_.push_back(results::point_key(experiment, i));
  }
  const std::vector<std::size_t>& points() const { return points_; }
  const std::string& key(std::size_t point) const {
    return keys_[std::size_t(std::ranges::lower_bound(points_, point) - points_.begin())];
  }
  std::vector<std::size_t> missing_in(const results::Journal& journal) const {
    std::vector<std::size_t> missing;
    for (std::size_t k = 0; k < points_.size(); ++k)
      if (!journal.has(keys_[k])) missing.push_back(points_[k]);
    return missing;
  }

 private:
  std::vector<std::size_t> points_;  // ascending
  std::vector<std::string> keys_;
};

// The points that no journal in the folder has. Unless force, copies those of other journals to this one.
std::vector<std::size_t> missing_points(const Experiment& experiment, const KeyedPoints& points,
                                        results::Journal& journal, bool force) {
  std::vector<std::size_t> missing = points.missing_in(journal);
  if (force || missing.empty()) return missing;
  std::set<std::string> keys;
  for (const std::size_t i : missing) keys.insert(points.key(i));
  journal.adopt(experiment, std::move(keys));
  return points.missing_in(journal);
}

// Computes the missing points and appends each to the journal when it is solved.
void fill_journal(const Experiment& experiment, const KeyedPoints& points,
                  const std::vector<std::size_t>& missing, int threads, results::Journal& journal,
                  Progress& progress) {
  const std::size_t all = points.points().size();
  std::size_t saved = all - missing.size();
  const auto sink = [&](PointReport&& report) {
    journal.append(points.key(report.index), std::move(report.record));
    ++saved;
    progress.step();
  };
  const auto slow = [&](std::size_t index, double seconds) {
    progress.note(fmt::format("{}: {} takes unusually long: {} so far", experiment.name,
                              experiment.place(index), duration_text(seconds)));
  };
  const auto passages = [&](std::size_t computed) { progress.add_passages(computed); };
  const auto saved_text = [&](const std::string& failure) {
    progress.finish();
    return fmt::format("{}; {} of {} points are saved in {}: the same command computes the rest", failure,
                       saved, all, journal.path());
  };
  bool complete = false;
  try {
    complete = run_sweep(experiment, missing, threads, sink, interrupted, {slow, passages});
    journal.sync();
  } catch (const RunError& e) {
    throw RunError(saved_text(e.what()));
  }
  if (!complete) throw Interrupted(saved_text("interrupted"));
}

std::vector<Gap> gaps_of(const std::vector<std::size_t>& indices, const KeyedPoints& points,
                         const results::Journal& journal) {
  std::vector<Gap> gaps;
  for (const std::size_t index : indices) gaps.push_back(gap_of(journal.read(points.key(index)).record));
  return gaps;
}

// The jumps of the gap between the points, which are all in the journal.
results::Rows find_jumps(const Experiment& experiment, const KeyedPoints& points, results::Journal& journal,
                         int threads, const TaskOptions& options) {
  if (experiment.locate_jumps.empty()) return {};
  const auto solve = [&](const Experiment& between, const std::vector<std::size_t>& indices) {
    const std::set<std::size_t> ascending(indices.begin(), indices.end());
    const KeyedPoints added(between, {ascending.begin(), ascending.end()});
    const auto missing = missing_points(between, added, journal, options.force);
    Progress progress(between.name, missing.size(), options.quiet);
    fill_journal(between, added, missing, threads, journal, progress);
    progress.finish();
    return gaps_of(indices, added, journal);
  };
  return locate_jumps(experiment, gaps_of(points.points(), points, journal), solve);
}

// Writes the result file from the journal, in the order of the points.
Summary write_result(const Task& task, const KeyedPoints& points, const results::Rows& jumps,
                     const results::Journal& journal, std::map<std::string, std::string> entries,
                     Progress& progress) {
  progress.stage("writing " + task.path);
  const results::RecordFormat format(task.experiment);
  Summary summary(task.experiment, task.path);
  std::set<std::string> commits;
  results::ResultWriter writer(task.experiment, task.path, task.shard);
  for (const std::size_t i : points.points()) {
    const results::JournalLine line = journal.read(points.key(i));
    if (!results::fits(line.record, format))
      throw RunError(fmt::format(
          "{}: its variables differ from those of this program; --force computes all points again",
          journal.path()));
    writer.write(i, line.record);
    summary.add(line.record, i);
    commits.insert(line.commit);
  }
  if (!jumps.empty()) writer.write_jumps(task.experiment.locate_jumps, jumps);
  entries["points_commits"] = fmt::format("{}", fmt::join(commits, ", "));
  entries["finished"] = utc_now();
  writer.close(entries);
  if (!task.shard && !task.experiment.checks.empty()) progress.stage("evaluating the checks");
  if (!task.shard) add_checks(writer.partial());
  writer.publish();
  progress.finish();
  return summary;
}

void compute(const Task& task, int threads, const TaskOptions& options) {
  install_signal_handlers();
  auto entries = provenance(options.command_line, threads);
  entries["started"] = utc_now();
  results::Journal journal(task.path, kCommit, options.force);
  const KeyedPoints points(task);
  const std::vector<std::size_t> missing = missing_points(task.experiment, points, journal, options.force);
  const std::size_t all = points.points().size(), found = all - missing.size();
  entries["points_computed"] = fmt::format("{} of {}", missing.size(), all);
  Progress progress(task.experiment.name, missing.size(), options.quiet);
  fill_journal(task.experiment, points, missing, threads, journal, progress);
  results::Rows jumps;
  if (!task.shard) jumps = find_jumps(task.experiment, points, journal, threads, options);
  const Summary summary = [&] {
    try {
      return write_result(task, points, jumps, journal, entries, progress);
    } catch (const RunError& e) {
      progress.finish();
      throw RunError(fmt::format("{}; all points are saved in {}: the same command writes the result",
                                 e.what(), journal.path()));
    }
  }();
  summary.report_failures();
  if (options.quiet) return;
  fmt::print("{}: points: {}{}\n", task.path, all > 0 ? summary.text() : "none in this shard",
             found > 0 ? fmt::format("; {} computed before", found) : std::string());
  summary.report_points_without_values();
}

}  // namespace

std::vector<std::size_t> Task::points() const {
  return results::shard_points(shard.value_or(results::Shard{1, 1}), experiment.points());
}

void run_task(const Task& task, const TaskOptions& options) {
  require_replaceable(task.path, results::replaceable_by(task.shard));
  if (!options.force && up_to_date(task.path, task.experiment, task.shard)) {
    refresh_description(task);
    if (!options.quiet)
      fmt::print("{} is up to date: nothing to compute (--force computes it again)\n", task.path);
    return;
  }
  compute(task, options.threads > 0 ? options.threads : all_cores(), options);
}

}  // namespace bristle::run
