#pragma once

#include "dynamics/passage.hpp"

#include <functional>
#include <memory>

namespace bristle {

// A computation that needs passages now and then and asks run for them.
using Job = std::function<void(const PassageRunner& run)>;

// A job on a stack of its own, suspended wherever it asks for passages. The sanitizers of addresses and threads
// do not support such stacks: see util/sanitizer.hpp.
class SuspendedJob {
 public:
  // Starts the job and returns when it first asks for passages, or when it has ended.
  explicit SuspendedJob(Job job);
  ~SuspendedJob();

  // The passages that the job is waiting for; null once it has ended.
  const std::vector<PassageTask>* waiting_for() const;
  // Continues the job with these passages until it asks for more or ends.
  void resume(std::vector<Passage> passages);

 private:
  struct Routine;
  std::unique_ptr<Routine> routine_;
};

// Runs the jobs concurrently on this thread: passages that they wait for at the same time go to run in one
// batch, which keeps the SIMD lanes full. The results equal those of running one job after the other.
void run_together(const std::vector<Job>& jobs, const PassageRunner& run);

}  // namespace bristle
