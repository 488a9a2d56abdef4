#pragma once

#include "results/writer.hpp"
#include "run/points.hpp"
#include "run/progress.hpp"
#include "run/shard.hpp"
#include "run/summary.hpp"
#include "run/scheduler.hpp"

#include <map>
#include <optional>
#include <string>

namespace bristle::run {

struct RunOptions {
  std::string output;            // the result file; journals are in the same folder
  std::optional<Shard> shard{};  // compute these points into a separate journal, and write no result
  bool complete = false;         // write the result of points that are in journals; throw if one is missing
  int threads = all_cores();
  bool force = false, quiet = false;
  std::vector<std::string> arguments{};  // arguments of the command line, for the provenance
};

// Brings the result file up to date with the experiment, or computes a shard of its points. Does not compute
// points again that are in the journal of the run or in another journal of its folder. Prints the number of
// points with each status unless options.quiet is set. Throws RunError if interrupted or if the disk is full;
// the computed points are then in the journal.
void run_experiment(const Experiment& experiment, const RunOptions& options);

// Throws InputError if this run, of any tier but full, would replace the result of another tier, unless
// options.force is set.
void require_no_loss(const Experiment& experiment, const RunOptions& options);

// Returns these points of a sweep, in the same order. Computes only points that no journal in the folder of
// the result has. Uses output, threads and force of the options. Throws as run_experiment().
std::vector<results::PointRecord> solve_points(const Sweep& sweep, const std::vector<std::size_t>& points,
                                               const RunOptions& options, results::Journal& journal,
                                               Progress& progress);

// Writes the result file from the journal, in the order of the points, with jumps, analysis, the groups
// `more` and the provenance. entries: facts of the provenance
Summary write_result(const Experiment& experiment, const std::string& path, const KeyedPoints& points,
                     const results::Rows& jumps, const std::vector<results::Dataset>& more,
                     const results::Journal& journal, std::map<std::string, std::string> entries,
                     Progress& progress);

}  // namespace bristle::run
