#pragma once

#include "checks/reference.hpp"

#include <string>
#include <vector>

namespace bristle {

// A value that differs from the reference's.
struct Deviation {
  std::string variable;
  std::size_t point;      // index in the file
  double reference, now;  // NaN: no value; for flags the codes
  double tolerances;      // size over the tolerance; infinite for flags, and where a value or a tolerance is missing
};

// A comparison of a result with its reference.
struct DeviationReport {
  std::vector<std::string> notes;     // information, not a failure
  std::vector<std::string> failures;  // of variables, axes and verdicts, which have no size
  std::vector<Deviation> deviations;  // worst first
  std::size_t points = 0, points_in_file = 0, values = 0;  // compared

  std::size_t above(double tolerances) const;  // deviations larger than this many tolerances
  bool failed() const { return !failures.empty() || above(1) > 0; }
};

// Compares what was computed (now), which may have more points, with the reference. A NaN, infinity, variable,
// shape, flag or verdict that differs is a failure; numbers may differ by the reference's tolerance.
DeviationReport compare_with_reference(const Reference& reference, const Reference& now);

}  // namespace bristle
