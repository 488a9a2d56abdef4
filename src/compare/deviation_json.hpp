#pragma once

#include "compare/deviation.hpp"
#include "results/reader.hpp"
#include "util/json.hpp"

#include <string>

namespace bristle::compare {

// The report as JSON: counts, the five worst deviations, failures and notes.
Json deviation_json(const DeviationReport& report, const results::ResultReader& result,
                    const std::string& reference);

}  // namespace bristle::compare
