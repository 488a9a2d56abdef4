#pragma once

#include "design/findings.hpp"

#include <string>
#include <vector>

namespace bristle::design {

// A dimension of the recommended brush, or another quantity of the design, for a workshop.
struct Dimension {
  std::string name, meaning, units;
  double value;
  double tolerance;     // relative to the value; NaN: none
  bool normal;          // the tolerance is a standard deviation; otherwise the greatest deviation
  double below, above;  // relative change of the value that reaches a jump of the gap; NaN: none in the range
  double band;  // tolerance with which 99 % of the brushes stay on this side of the jumps; NaN: no jump
};

// What the recommended brush does in one scenario. NaN: not known, as the lift-off load of bristles that lean
// one way.
struct Working {
  double velocity;  // of the slab, m/s
  double load;      // R_n, N
  double phase;     // code of a BrushPhase
  double load_over_lift_off;
};

// Returns the dimensions of the recommended brush, then all other variables of the design and quantities with
// a tolerance. Empty unless the experiment is in SI units.
std::vector<Dimension> drawing(const Trials& trials, const Findings& found);

// Returns the group /drawing of the result. The dimensions must not be empty.
results::Dataset drawing_group(const std::vector<Dimension>& dimensions);

// Returns what the recommended brush does in each scenario. sweep: the recommended brush in SI units. points:
// its points, as computed.
std::vector<Working> working_range(const Sweep& sweep, const std::vector<results::PointRecord>& points);
// Returns the group /working_range of the result.
results::Dataset working_range_group(const std::vector<Working>& range);
// Returns the working range in words, a line for each scenario.
std::string working_range_text(const std::vector<Working>& range);

// Returns the drawing in words: a table of the dimensions, and how the bristles stand and lean.
std::string drawing_text(const std::vector<Dimension>& dimensions, const Orientation& orientation);

}  // namespace bristle::design
