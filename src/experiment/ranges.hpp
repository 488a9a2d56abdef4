#pragma once

#include "json/document.hpp"
#include "sweep/sweep.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bristle::experiment {

// A quantity that a design chooses between two values.
struct Range {
  std::string name;
  double low, high;
  bool log;  // searched evenly in the logarithm

  // Returns the value at a share of the range, in [0, 1], to seven digits.
  double at(double share) const;
};

// How a quantity of the brush as made deviates from its nominal value, relative to it.
struct Tolerance {
  std::string name;
  bool normal;     // otherwise uniform
  double width;    // standard deviation, or greatest deviation
  double nominal;  // NaN for a variable of the design
};

// The quantities that the trials of a design vary: its variables and tolerances.
struct Ranges {
  std::vector<Range> variables;
  std::vector<Tolerance> tolerances;
  double jump_margin = 0;  // relative distance of a trial's neighbours; 0: none

  bool empty() const { return variables.empty(); }
  // Returns the names of the variables, and of the quantities with a tolerance that are no variables.
  std::vector<std::string> quantities() const;
  // Returns the names of the quantities that have a tolerance.
  std::vector<std::string> tolerated() const;
  // Returns the columns of the axis "sample" before trials are known: the least and the greatest values.
  std::vector<sweep::Axis> bounds() const;
  // Returns an axis for each quantity, from the least to the greatest value that any trial may have with its
  // deviations, neighbours and profiles.
  std::vector<sweep::Axis> extremes() const;
};

// Returns the value that the experiment itself gives a sweepable number: in its block, or the width of the
// scatter, which is 0 without one. None if it gives no number.
std::optional<double> own_value(const json::Document& document, const std::string& name);

// Reads the variables and tolerances of /design; they are empty without the block. Throws InputError unless
// all values that trials may have are in the ranges of their quantities.
Ranges read_ranges(const json::Document& document);

}  // namespace bristle::experiment
