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
  std::optional<Shard> shard{};  // compute these points into a journal of their own, and write no result
  bool complete = false;         // write the result of points that are in journals; throw if one is missing
  int threads = all_cores();
  bool force = false, quiet = false;
  std::vector<std::string> arguments{};  // of the command line, stored in the provenance
};

// Brings the result file up to date with the experiment, or computes a shard of its points. Points that are
// in its journal, or in another journal in its folder, are not computed again. Prints the number of points
// with each status unless quiet. Throws RunError if interrupted or if the disk is full; the computed points
// are then in the journal.
void run_experiment(const Experiment& experiment, const RunOptions& options);

// Throws InputError if the output holds the result of another tier, and this run of a tier with fewer points
// would replace it, unless it is forced to.
void require_no_loss(const Experiment& experiment, const RunOptions& options);

// Computes these points of a sweep, as far as no journal in the folder of the result has them, and
// returns all, in the same order. options: output, threads, force. Throws as run_experiment().
std::vector<results::PointRecord> solve_points(const Sweep& sweep, const std::vector<std::size_t>& points,
                                               const RunOptions& options, results::Journal& journal,
                                               Progress& progress);

// Writes the result file from the journal, in the order of the points, with jumps, analysis, more groups and
// provenance.
Summary write_result(const Experiment& experiment, const std::string& path, const KeyedPoints& points,
                     const results::Rows& jumps, const std::vector<results::Dataset>& more,
                     const results::Journal& journal, std::map<std::string, std::string> entries,
                     Progress& progress);

}  // namespace bristle::run
