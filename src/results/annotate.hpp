#pragma once

#include "experiment/experiment.hpp"

#include <map>
#include <string>

namespace bristle::results {

// Writes the root attributes of a result file: versions, title, caption, the experiment with --set and tier
// applied, digests of the inputs, and the origin by the CF conventions. provenance: the texts of /provenance.
void annotate(const std::string& path, const Experiment& experiment,
              const std::map<std::string, std::string>& provenance);

}  // namespace bristle::results
