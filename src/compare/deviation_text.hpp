#pragma once

#include "compare/deviation.hpp"
#include "results/reader.hpp"

#include <string>

namespace bristle::compare {

// The report as text: the five worst deviations, or up to 25 if more exceed half their tolerance, and the
// commands that compute their points again. reference: path of the reference, for the summary.
std::string deviation_text(const DeviationReport& report, const results::ResultReader& result,
                           const std::string& reference);

}  // namespace bristle::compare
