#pragma once

#include "experiment/experiment.hpp"

#include <string>

namespace bristle::results {

// Writes the root attributes: versions, title, caption, the experiment with --set and tier applied, digests
// of the inputs, and the origin by the CF conventions (from /provenance).
void annotate(const std::string& path, const Experiment& experiment);

}  // namespace bristle::results
