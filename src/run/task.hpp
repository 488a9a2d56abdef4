#pragma once

#include "experiment/experiment.hpp"
#include "results/part.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bristle::run {

// Input and output of a run.
struct Task {
  const Experiment& experiment;
  std::optional<results::Shard> shard;  // none: all points
  std::string path;                     // of the result file; the journal is in the same folder

  std::vector<std::size_t> points() const;  // of the shard
};

struct TaskOptions {
  int threads = 0;  // 0: all cores
  bool force = false, quiet = false;
  std::string command_line;  // stored in the provenance
};

// Brings the result file up to date with the experiment. Points that are in its journal, or in another
// journal in its folder, are not computed again. Prints the number of points with each status unless quiet.
// Throws RunError if interrupted or if the disk is full; the computed points are then in the journal.
void run_task(const Task& task, const TaskOptions& options);

}  // namespace bristle::run
