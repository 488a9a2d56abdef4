#pragma once

#include "claims/checks.hpp"
#include "results/csv.hpp"

namespace bristle::claims {

// Writes the checks to the group /checks of a result file, replacing earlier ones.
void write_checks(const std::string& path, const std::vector<CheckResult>& checks);

// The same columns, for an export.
std::vector<results::CsvColumn> csv_columns(const std::vector<CheckResult>& checks);

}  // namespace bristle::claims
