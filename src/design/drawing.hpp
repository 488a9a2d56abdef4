#pragma once

#include "design/findings.hpp"

#include <string>
#include <vector>

namespace bristle::design {

// A dimension of the recommended brush, for a workshop.
struct Dimension {
  std::string name, meaning, units;
  double value;
  double tolerance;     // relative to the value; NaN: none
  bool normal;          // the tolerance is a standard deviation; otherwise the greatest deviation
  double below, above;  // relative change of the value that reaches a jump of the gap; NaN: none in the range
};

// Returns the dimensions of the recommended brush. Empty unless the experiment is in SI units.
std::vector<Dimension> drawing(const Trials& trials, const Findings& found);

// Returns the group /drawing of the result. The dimensions must not be empty.
results::Dataset drawing_group(const std::vector<Dimension>& dimensions);

// Returns what the recommended brush does in its working range, a line for each scenario: its phase, and the
// speed above which it bounces. sweep: the recommended brush in SI units. points: its points, as computed.
std::string working_range_text(const Sweep& sweep, const std::vector<results::PointRecord>& points);

// Returns the drawing in words: a line for each dimension, and how the bristles stand and lean.
std::string drawing_text(const std::vector<Dimension>& dimensions, const Orientation& orientation);

}  // namespace bristle::design
