#pragma once

#include "experiment/experiment.hpp"
#include "results/part.hpp"

#include <optional>
#include <string>

namespace bristle::results {

// Writes the root attributes: versions, title, caption, the experiment with --set and tier applied, and
// digests of the inputs.
void annotate(const std::string& path, const Experiment& experiment, const std::optional<Shard>& shard = {});

}  // namespace bristle::results
