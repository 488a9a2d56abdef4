#pragma once

#include "design/findings.hpp"

namespace bristle::design {

constexpr const char* kViolated = "violated";  // group of the constraints that the recommended brush violates

// Returns the groups /trials first, /best, /comparison, /margins, /profile_NAME, /verification, /violated and
// /indices of the result.
std::vector<results::Dataset> groups_of(const Trials& trials, const Findings& found);

}  // namespace bristle::design
