#include "run/task.hpp"

#include "claims/checks.hpp"
#include "claims/store.hpp"
#include "json/node.hpp"
#include "results/annotate.hpp"
#include "results/writer.hpp"
#include "run/analysis.hpp"
#include "run/jumps.hpp"
#include "run/points.hpp"
#include "run/progress.hpp"
#include "run/provenance.hpp"
#include "run/signals.hpp"
#include "run/summary.hpp"
#include "util/error.hpp"
#include "util/file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
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
void refresh_description(const Experiment& experiment, const std::string& path) {
  const results::ResultReader result(path);
  if (result.experiment() == *experiment.document) return;
  const results::Journal lock(journal_path(path, {}), kCommit, false);
  WholeFile copy(path, results::result_file());
  copy.write(read_file(path));
  copy.close();
  results::annotate(copy.partial(), experiment, result.provenance());
  add_checks(copy.partial());
  copy.publish();
}

// Returns the points that the journal lacks. Unless force is set, copies points from the other journals of
// the folder to this one first.
std::vector<std::size_t> missing_points(const KeyedPoints& points, results::Journal& journal, bool force) {
  std::vector<std::size_t> missing = points.missing_in(journal);
  if (!force && !missing.empty()) {
    points.adopt_into(journal);
    missing = points.missing_in(journal);
  }
  return missing;
}

// Returns what continues an interrupted run, as its user types it.
std::string same_command(const RunOptions& options) {
  return options.force ? "the same command without --force" : "the same command";
}

// Computes the missing points and appends each to the journal when it is solved.
void fill_journal(const Sweep& sweep, const KeyedPoints& points, const std::vector<std::size_t>& missing,
                  const RunOptions& options, results::Journal& journal, Progress& progress) {
  const std::size_t all = points.points().size();
  std::size_t saved = all - missing.size();
  const auto sink = [&](PointReport&& report) {
    journal.append(points.key(report.index), report.record);
    ++saved;
    progress.step();
  };
  const auto slow = [&](std::size_t index, double seconds) {
    progress.note(fmt::format("{} takes unusually long: {} of processor time so far", sweep.place(index),
                              duration_text(seconds)));
  };
  const auto passages = [&](std::size_t computed) { progress.add_passages(computed); };
  const auto saved_text = [&] {
    progress.finish();
    return fmt::format("{} of {} points are saved in {}: {} computes the rest", saved, all, journal.path(),
                       same_command(options));
  };
  bool complete = false;
  try {
    complete = run_sweep(sweep, missing, options.threads, sink, interrupted, {slow, passages});
    journal.sync();
  } catch (const RunError& e) {
    throw RunError(e.reason(), saved_text());
  }
  if (!complete) throw Interrupted("interrupted", saved_text());
}

// Finds the jumps of the gap between the points, which are all in the journal.
results::Rows find_jumps(const Experiment& experiment, const KeyedPoints& points, results::Journal& journal,
                         const RunOptions& options) {
  if (experiment.locate_jumps.empty()) return {};
  const std::string name = fmt::format("{}: jumps along {}", experiment.name, experiment.locate_jumps);
  const auto solve = [&](const Sweep& between, const std::vector<std::size_t>& indices) {
    Progress progress(name, indices.size(), options.quiet);
    std::vector<Gap> gaps;
    for (const results::PointRecord& record : solve_points(between, indices, options, journal, progress))
      gaps.push_back(gap_of(record));
    progress.finish();
    return gaps;
  };
  std::vector<Gap> gaps;
  for (const std::size_t index : points.points())
    gaps.push_back(gap_of(journal.read(points.key(index), points.layout()).record));
  return locate_jumps(experiment.sweep, experiment.locate_jumps, gaps, solve);
}

// Writes the result with the jumps between the points. Removes the journals of shards, whose points are now
// all in the journal of the result.
Summary finish(const Experiment& experiment, const RunOptions& options, const KeyedPoints& points,
               results::Journal& journal, const std::map<std::string, std::string>& entries,
               Progress& progress) {
  const std::string saved =
      fmt::format("all points are saved in {}: {} writes the result", journal.path(), same_command(options));
  try {
    const results::Rows jumps = find_jumps(experiment, points, journal, options);
    Summary summary = write_result(experiment, options.output, points, jumps, {}, journal, entries, progress);
    for (const auto& [shard, path] : shard_journals(options.output)) journal.remove_copied(path);
    return summary;
  } catch (const Interrupted&) {
    progress.finish();
    throw Interrupted("interrupted", saved);
  } catch (const RunError& e) {
    progress.finish();
    throw RunError(e.reason(), saved);
  }
}

// Returns the summary of a shard's journal.
Summary summary_of(const Sweep& sweep, const KeyedPoints& points, const results::Journal& journal) {
  Summary summary(sweep, journal.path());
  for (const std::size_t i : points.points())
    summary.add(journal.read(points.key(i), points.layout()).record, i);
  return summary;
}

// Prints what remains to be done after a shard.
void print_rest(const Experiment& experiment, const RunOptions& options) {
  const KeyedPoints all(experiment.sweep, shard_points({}, experiment.sweep.size()));
  if (const std::size_t missing = all.missing_beside(options.output).size(); missing > 0)
    fmt::print("{} of {} points of {} are not yet in the journals of this folder\n", missing,
               experiment.sweep.size(), experiment.name);
  else
    fmt::print("all {} points of {} are in the journals of this folder; to write {}:\n  {}\n",
               experiment.sweep.size(), experiment.name, options.output,
               command_with(options.arguments, "--complete"));
}

void compute(const Experiment& experiment, const RunOptions& options) {
  install_signal_handlers();
  auto entries = provenance(options.arguments, options.threads);
  entries["started"] = utc_now();
  entries["experiment_file"] = experiment.path;
  const KeyedPoints points(experiment.sweep, shard_points(options.shard, experiment.sweep.size()));
  const auto require_points = [&](const std::vector<std::size_t>& missing) {
    if (options.complete) require_complete(experiment.sweep, missing, options.output, options.arguments);
  };
  if (options.complete) require_points(points.missing_beside(options.output));
  results::Journal journal(journal_path(options.output, options.shard), kCommit, options.force);
  const std::vector<std::size_t> missing = missing_points(points, journal, options.force);
  require_points(missing);
  const std::size_t all = points.points().size(), found = all - missing.size();
  entries["points_computed"] = fmt::format("{} of {}", missing.size(), all);
  Progress progress(experiment.name, missing.size(), options.quiet);
  fill_journal(experiment.sweep, points, missing, options, journal, progress);
  const Summary summary = options.shard ? summary_of(experiment.sweep, points, journal)
                                        : finish(experiment, options, points, journal, entries, progress);
  progress.finish();
  summary.report_failures();
  if (options.quiet) return;
  fmt::print("{}: points: {}{}\n", options.shard ? journal.path() : options.output,
             all > 0 ? summary.text() : "none in this shard",
             found > 0 ? fmt::format("; {} computed before", found) : std::string());
  fmt::print("{}", summary.phases());
  summary.report_points_without_values();
  summary.report_pinned_bristles();
  summary.report_validity();
  fmt::print("{}", summary.analysis());
  if (options.shard) print_rest(experiment, options);
}

}  // namespace

std::vector<results::PointRecord> solve_points(const Sweep& sweep, const std::vector<std::size_t>& points,
                                               const RunOptions& options, results::Journal& journal,
                                               Progress& progress) {
  const std::set<std::size_t> ascending(points.begin(), points.end());
  const KeyedPoints keyed(sweep, {ascending.begin(), ascending.end()});
  const std::vector<std::size_t> missing = missing_points(keyed, journal, options.force);
  for (std::size_t found = missing.size(); found < ascending.size(); ++found) progress.step();
  fill_journal(sweep, keyed, missing, options, journal, progress);
  std::vector<results::PointRecord> records;
  for (const std::size_t point : points)
    records.push_back(journal.read(keyed.key(point), keyed.layout()).record);
  return records;
}

Summary write_result(const Experiment& experiment, const std::string& path, const KeyedPoints& points,
                     const results::Rows& jumps, const std::vector<results::Dataset>& more,
                     const results::Journal& journal, std::map<std::string, std::string> entries,
                     Progress& progress) {
  progress.stage("writing " + path);
  Summary summary(experiment.sweep, path);
  std::set<std::string> commits, hosts;
  results::ResultWriter writer(experiment, path);
  std::map<std::string, std::vector<double>> analysed;
  for (const std::size_t i : points.points()) {
    const results::JournalLine line = journal.read(points.key(i), points.layout());
    for (const std::string& name : analysed_variables(experiment))
      analysed[name].push_back(line.record.at(name));
    writer.write(i, line.record);
    summary.add(line.record, i);
    commits.insert(line.commit);
    hosts.insert(line.host);
  }
  if (!jumps.empty()) writer.write_jumps(experiment.locate_jumps, jumps);
  const std::vector<results::Dataset> groups = analyse(experiment, analysed);
  for (const auto* list : {&groups, &more})
    for (const results::Dataset& group : *list) writer.write_group(group);
  summary.add(analysis_text(experiment, groups));
  entries["points_commits"] = fmt::format("{}", fmt::join(commits, ", "));
  entries["points_hosts"] = fmt::format("{}", fmt::join(hosts, ", "));
  entries["finished"] = utc_now();
  writer.close(entries);
  if (json::Node(*experiment.source, "/checks").exists()) progress.stage("evaluating the checks");
  add_checks(writer.partial());
  writer.publish();
  progress.finish();
  return summary;
}

void require_no_loss(const Experiment& experiment, const RunOptions& options) {
  const std::string& path = options.output;
  if (options.force || experiment.tier == "full" || !is_of_kind(path, results::result_file())) return;
  std::string held = experiment.tier;
  try {
    held = results::ResultReader(path).text("tier");
  } catch (const InputError&) {  // damaged: nothing is lost
  }
  if (held != experiment.tier)
    throw InputError(fmt::format(
        "{}: holds the result of the {} tier, which the {} tier would replace; give another file with -o",
        path, held, experiment.tier));
}

void run_experiment(const Experiment& experiment, const RunOptions& options) {
  read_analysis(experiment);
  require_replaceable(options.output, results::result_file());
  if (!options.force && results::up_to_date(options.output, experiment)) {
    if (!options.shard) refresh_description(experiment, options.output);
    if (!options.quiet)
      fmt::print("{} is up to date: nothing to compute (--force computes it again)\n", options.output);
    return;
  }
  if (!options.shard) require_no_loss(experiment, options);
  compute(experiment, options);
}

}  // namespace bristle::run
