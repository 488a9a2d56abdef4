#pragma once

#include "results/reader.hpp"

#include <string>
#include <vector>

// Properties of the datasets of a result file, for comparisons. Names are paths from the root, such as "R_x"
// and "bristles/theta_0".
namespace bristle::results {

enum class DatasetKind {
  coordinate,  // values along a dimension (a dimension scale)
  flags,       // codes with meanings, such as status: a difference has no size
  integer,     // counts and indices
  real
};

// The datasets of the payload. The axis of a choice stands for its words and codes.
std::vector<std::string> numeric_datasets(const ResultReader& result);

DatasetKind kind_of(const ResultReader& result, const std::string& name);

// Coordinates of a value, such as "k_r = 2, k_theta = 0.3"; the row number for a dimension without
// coordinates.
std::string place(const ResultReader& result, const std::string& name, std::size_t index);

// A value of a variable for messages: the meaning of a flag, or a number with enough digits to identify it.
std::string value_text(const ResultReader& result, const std::string& name, double value);

// NaN equals NaN; zeros of opposite signs differ.
bool same_bits(double a, double b);

}  // namespace bristle::results
