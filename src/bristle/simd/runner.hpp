#pragma once

#include "bristle/dynamics/passage.hpp"

namespace bristle {

// A runner that computes one batch of passages at a time with this engine. Throws std::runtime_error if the
// processor lacks the instructions that the SIMD engine needs.
PassageRunner make_runner(Engine engine);

}  // namespace bristle
