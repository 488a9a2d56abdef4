#pragma once

#include "dynamics/runner.hpp"

namespace bristle {

// Something that needs passages now and then.
using Job = std::function<void(const PassageRunner& run)>;

// Does the jobs side by side on this thread: the passages that they wait for at the same time are asked of
// run in one batch, which keeps the lanes full. The results are those of one job after the other.
void run_together(const std::vector<Job>& jobs, const PassageRunner& run);

// Stack of a job: what the equilibrium, the quadrature and a scalar passage take, with room to spare.
constexpr std::size_t kJobStackBytes = 256 << 10;

}  // namespace bristle
