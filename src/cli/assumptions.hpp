#pragma once

#include "assumptions/assumptions.hpp"

namespace bristle::cli {

// The command `assumptions`. Returns the exit code; throws InputError or RunError.
int assumptions_command(assumptions::AssumptionsOptions options);

}  // namespace bristle::cli
