#pragma once

#include "bristle/dynamics/passage.hpp"

#include <functional>
#include <memory>

namespace bristle {

// A computation that calls `run` whenever it needs passages.
using Job = std::function<void(const PassageRunner& run)>;

// A job with its own stack, suspended at each call of `run`. AddressSanitizer and ThreadSanitizer do not
// support such stacks: see bristle/sanitizer.hpp.
class SuspendedJob {
 public:
  // Starts the job; returns at its first request for passages, or at its end.
  explicit SuspendedJob(Job job);
  ~SuspendedJob();

  // Returns the requested passages; null once the job has ended.
  const std::vector<PassageTask>* waiting_for() const;
  // Resumes the job with the requested passages; returns at its next request or at its end.
  void resume(std::vector<Passage> passages);

 private:
  struct Routine;
  std::unique_ptr<Routine> routine_;
};

// Runs the jobs interleaved on this thread. Passages for which several jobs wait go to `run` in one batch,
// which keeps the SIMD lanes full. The results are the same as if one job ran after the other.
void run_together(const std::vector<Job>& jobs, const PassageRunner& run);

}  // namespace bristle
