#pragma once

#include "experiment/experiment.hpp"
#include "results/part.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bristle {

// What a run is to compute, and where to.
struct Task {
  const Experiment& experiment;
  std::optional<Shard> shard;  // none: the whole
  std::string path;            // of the result file; its journal lies beside it

  std::vector<std::size_t> points() const;
};

struct TaskOptions {
  int threads = 0;  // 0: all cores
  bool force = false, quiet = false;
  std::string command_line;  // for the record
};

// Makes the result file be that of the experiment: what the journal or another in its folder has is not
// computed again. Prints what became of the points unless quiet. Throws RunError if interrupted or if there
// is no room; what was computed is in the journal then.
void run_task(const Task& task, const TaskOptions& options);

}  // namespace bristle
