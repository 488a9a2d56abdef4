#pragma once

#include "ensemble/load_path.hpp"

#include <optional>

namespace bristle {

// Scans the path for its first crossing of the target, at gaps a step apart and within humps of R_n(z_0)
// between them. The loads of the bracket are precise. None if the path does not cross the target.
std::optional<LoadBracket> scan_for_crossing(LoadsOnPath& loads);

}  // namespace bristle
