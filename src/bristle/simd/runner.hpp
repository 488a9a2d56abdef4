#pragma once

#include "bristle/dynamics/passage.hpp"

namespace bristle {

// Returns a runner that computes one batch of passages at a time with this engine. The runner keeps its
// engine for the next batch, and its copies share it: each thread needs a runner of its own. Throws
// std::runtime_error if the processor lacks the instructions that the SIMD engine needs.
PassageRunner make_runner(Engine engine);

}  // namespace bristle
