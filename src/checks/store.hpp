#pragma once

#include "checks/checks.hpp"

namespace bristle::checks {

// Writes the checks to the group /checks of a result file, replacing earlier ones.
void write_checks(const std::string& path, const std::vector<CheckResult>& checks);

}  // namespace bristle::checks
