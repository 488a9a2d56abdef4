#pragma once

#include "experiment/design.hpp"
#include "results/record.hpp"
#include "util/sensitivity.hpp"

#include <limits>
#include <string>
#include <vector>

namespace bristle::design {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Returns the value of a variable at a point, and its error; 0 if it has none.
Estimate value_of(const results::PointRecord& record, const std::string& variable);

// Returns the statistic of the values at deviations, NaN if one of them is NaN. Its error contains that of
// few values, with the tail that they do not show, and the mean error of the values.
Estimate statistic(Statistic of, const std::vector<Estimate>& all);

// Returns the number to be minimised.
double cost(const experiment::Objective& objective, double value);

// Returns the scenario with the highest cost; one without a value is worse than all.
std::size_t worst_scenario(const experiment::Objective& objective, const std::vector<Estimate>& by_scenario);

}  // namespace bristle::design
