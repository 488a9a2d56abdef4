#pragma once

#include "checks/deviation.hpp"
#include "results/reader.hpp"

#include <string>

namespace bristle {

// A report for people: the worst five deviations, and up to 25 that exceed half their tolerance, with the
// commands that compute their points again. reference: the path of its file.
std::string deviation_text(const DeviationReport& report, const ResultReader& result,
                           const std::string& reference);

}  // namespace bristle
