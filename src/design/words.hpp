#pragma once

#include "design/findings.hpp"

namespace bristle::design {

// Returns what was found in words, half a screen: what is recommended, compared with the start and verified.
std::string text_of(const Trials& trials, const Findings& found);
// Returns the rest in words: the shares of the tolerances, and other optima.
std::string details_of(const Trials& trials, const Findings& found);

}  // namespace bristle::design
