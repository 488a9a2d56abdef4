#pragma once

#include <string>
#include <vector>

namespace bristle::results {

// Tells in a line what the brushes at points with these phases do: values of the variable phase, the indices of
// the words of BrushPhase. Empty if no point has a known phase.
std::string phase_text(const std::vector<double>& phases);

}  // namespace bristle::results
