#pragma once

#include "results/reader.hpp"

#include <string>
#include <vector>

// What every comparison of result files needs to know of a dataset. Names are paths from the root, as
// "R_x" or "bristles/theta_0".
namespace bristle {

enum class Kind {
  axis,     // a dimension's coordinates
  flags,    // codes with meanings, as status: equal or not, without a distance
  integer,  // counts and indices
  real
};

// Every dataset of numbers but those of /checks and /provenance.
std::vector<std::string> numeric_datasets(const ResultReader& result);

Kind kind_of(const ResultReader& result, const std::string& name);

// Where a value is: "k_r = 2, k_theta = 0.3", or the row where no axis labels a dimension.
std::string place(const ResultReader& result, const std::string& name, std::size_t index);

// Number of a variable for people: its flag's meaning, or all digits that tell it from other numbers.
std::string value_text(const ResultReader& result, const std::string& name, double value);

// NaN equals NaN; zeros of opposite signs differ.
bool same_bits(double a, double b);

// Row-major index from the position along each dimension, and back.
std::size_t ravel(const std::vector<std::size_t>& at, const std::vector<std::size_t>& shape);
std::vector<std::size_t> unravel(std::size_t index, const std::vector<std::size_t>& shape);

// One word of a shell's command line.
std::string shell_quoted(const std::string& text);

}  // namespace bristle
