#include "bristle/dynamics/jobs.hpp"

namespace bristle {

// Runs the jobs one after the other, because WebAssembly has no stacks that could be exchanged. Their numbers
// are those of jobs that run together.
void run_together(const std::vector<Job>& jobs, const PassageRunner& run) {
  for (const Job& job : jobs) job(run);
}

}  // namespace bristle
