#pragma once

#include "experiment/experiment.hpp"
#include "run/shard.hpp"

#include <optional>
#include <string>

namespace bristle::run {

struct RunOptions {
  std::string output;            // the result file; journals are in the same folder
  std::optional<Shard> shard{};  // compute these points into a journal of their own, and write no result
  bool complete = false;         // write the result of points that are in journals; throw if one is missing
  int threads = 0;               // 0: all cores
  bool force = false, quiet = false;
  std::string command_line{};  // stored in the provenance
};

// Brings the result file up to date with the experiment, or computes a shard of its points. Points that are
// in its journal, or in another journal in its folder, are not computed again. Prints the number of points
// with each status unless quiet. Throws RunError if interrupted or if the disk is full; the computed points
// are then in the journal.
void run_experiment(const Experiment& experiment, const RunOptions& options);

}  // namespace bristle::run
