#pragma once

#include "dynamics/passage.hpp"

#include <vector>

namespace bristle {

enum class Engine {
  fast,      // one bristle per SIMD lane
  reference  // one after the other by Boost.Odeint
};

// Computes passages; the results are in the order of the tasks.
using PassageRunner = std::function<std::vector<Passage>(const std::vector<PassageTask>&)>;

// The engine, working on one batch at a time. Throws std::runtime_error if the processor cannot run the fast
// one.
PassageRunner make_runner(Engine engine);

}  // namespace bristle
