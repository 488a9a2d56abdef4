#pragma once

#include <string>
#include <vector>

namespace bristle {

// " (did you mean x?)" for the known word nearest to this one, or nothing if none is near.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known);

}  // namespace bristle
