#pragma once

#include "design/findings.hpp"

namespace bristle::design {

// Returns the findings in words.
std::string text_of(const Trials& trials, const Findings& found);

}  // namespace bristle::design
