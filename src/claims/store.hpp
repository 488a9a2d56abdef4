#pragma once

#include "claims/checks.hpp"
#include "results/dataset.hpp"

namespace bristle::claims {

// Returns the group /checks of a result file: a row for each check.
results::Dataset dataset_of(const std::vector<CheckResult>& checks);

// Writes the checks to the group /checks of a result file, replacing earlier ones.
void write_checks(const std::string& path, const std::vector<CheckResult>& checks);

}  // namespace bristle::claims
