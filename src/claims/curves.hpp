#pragma once

#include "experiment/check.hpp"
#include "results/reader.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bristle::claims {

// A value and its error estimate at an abscissa.
struct CurvePoint {
  double x, value, error;
  double x_error = 0;
  bool behind_jump = false;  // of z_0; for a check that distinguishes pairs of points
};
using Curve = std::vector<CurvePoint>;

// Curves along one dimension of a result, the input of predicates.
struct Curves {
  std::vector<Curve> curves;
  std::size_t missing = 0;   // number of points without a value, which are omitted
  bool independent = false;  // the errors are independent and add in quadrature, otherwise linearly
};

// A variable with its errors over the sweep, in row-major order. kept marks the selected points.
struct CheckedField : results::Array {
  std::vector<double> errors;
  std::vector<bool> kept;
};

// The variable of a check, divided by powers of other variables, at the points that "where" selects. "at"
// reduces every traced curve to one value by linear interpolation between nodes: at the given load on the
// loading path or, for a variable other than R_n, where that variable first crosses the given value. The
// error then includes the difference from the nearer node. All members throw InputError for a name that the
// result does not have.
class CheckedCurves {
 public:
  // side: for a check with "compare", which of its values to measure at, 0 or 1.
  CheckedCurves(const results::ResultReader& result, const experiment::Check& check,
                std::optional<std::size_t> side = {});

  // Curves along the check's dimension, or another one, over that axis or over the check's variable x.
  Curves along() const;
  Curves along(const std::string& dimension) const;
  // The same along the check's dimension, of the curves that have values at the first and at the last
  // selected point: the others do not show a change from end to end.
  Curves from_end_to_end() const;
  // All selected points in row-major order, including those without a value.
  Curve points() const;

 private:
  CheckedField field_of(const std::string& variable) const;
  Curves curves(const std::string& dimension, bool whole) const;

  const results::ResultReader& result_;
  const experiment::Check& check_;
  std::optional<std::size_t> side_;
};

}  // namespace bristle::claims
