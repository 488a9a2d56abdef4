#pragma once

#include "assumptions/assumptions.hpp"

namespace bristle {

// The command `assumptions`. Returns the exit code; throws InputError or RunError.
int assumptions_command(AssumptionsOptions options);

}  // namespace bristle
