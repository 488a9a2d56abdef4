#pragma once

#include "checks/checks.hpp"

namespace bristle {

// Replaces the group /checks of a result file by these.
void write_checks(const std::string& path, const std::vector<CheckResult>& checks);

}  // namespace bristle
