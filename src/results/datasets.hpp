#pragma once

#include "results/reader.hpp"

#include <string>
#include <vector>

// Properties of a result file's datasets that comparisons need. Names are paths from the root, as "R_x" or
// "bristles/theta_0".
namespace bristle {

enum class Kind {
  axis,     // coordinates of a dimension
  flags,    // codes with meanings, as status: equal or not, without a distance
  integer,  // counts and indices
  real
};

// The numeric datasets of the payload.
std::vector<std::string> numeric_datasets(const ResultReader& result);

Kind kind_of(const ResultReader& result, const std::string& name);

// Coordinates of a value, as "k_r = 2, k_theta = 0.3"; the row's number along a dimension without coordinates.
std::string place(const ResultReader& result, const std::string& name, std::size_t index);

// A variable's value for messages: the meaning of a flag, or enough digits to identify the number.
std::string value_text(const ResultReader& result, const std::string& name, double value);

// NaN equals NaN; zeros of opposite signs differ.
bool same_bits(double a, double b);

}  // namespace bristle
