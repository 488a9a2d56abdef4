#pragma once

#include "compare/reference.hpp"

#include <string>
#include <vector>

namespace bristle::compare {

// A value that differs from the reference.
struct Deviation {
  std::string variable;
  std::size_t point;      // index in the file
  double reference, now;  // NaN: no value; codes of flags
  double
      tolerances;  // in units of the tolerance; infinite for flags and if a value or the tolerance is missing
};

// A comparison of a result with its reference.
struct DeviationReport {
  std::vector<std::string> notes;      // information, not a failure
  std::vector<std::string> failures;   // differences of variables, axes and verdicts, which have no size
  std::vector<Deviation> deviations;   // worst first
  std::size_t points = 0, values = 0;  // compared
  std::size_t points_in_file = 0;

  std::size_t above(double tolerances) const;  // number of deviations above this many tolerances
  bool failed() const { return !failures.empty() || above(1) > 0; }
};

// Compares a result (now) with the reference. The result may have more points than the reference. A
// difference of a NaN, an infinity, a variable, a shape, a flag or a verdict is a failure; finite numbers may
// differ by the tolerance of the reference.
DeviationReport compare_with_reference(const Reference& reference, const Reference& now);

}  // namespace bristle::compare
