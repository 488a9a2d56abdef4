#pragma once

#include "design/block.hpp"
#include "results/record.hpp"
#include "sampling/sensitivity.hpp"

#include <limits>
#include <string>
#include <vector>

namespace bristle::design {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Returns the value of a variable at a point, with its error, or with 0 if the variable has no error.
Quantity value_of(const results::PointRecord& record, const std::string& variable);

// Returns the statistic of the values at all deviations; NaN if one value is NaN. The error of a mean or a
// quantile combines the error due to the small number of values, with the tail that they do not show, and the
// mean error of the values.
Quantity statistic(Statistic of, const std::vector<Quantity>& all);

// Returns the mean square of the errors of the values: the part of the square of the error of a statistic
// that does not come from the number of values.
double mean_square_error(const std::vector<Quantity>& all);

// Returns the number that the search minimises, for a value of the objective.
double cost(const Objective& objective, double value);

// Returns the scenario with the highest cost; a scenario without a value is worse than all others.
std::size_t worst_scenario(const Objective& objective, const std::vector<Quantity>& by_scenario);

}  // namespace bristle::design
