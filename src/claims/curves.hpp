#pragma once

#include "claims/check.hpp"
#include "results/reader.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bristle::claims {

// A value and its error estimate at an abscissa.
struct CurvePoint {
  double x, value, error;
  double x_error = 0;
  bool behind_jump = false;  // the point is behind the jump of z_0; for checks that distinguish pairs
};
using Curve = std::vector<CurvePoint>;

// Curves along one dimension of a result: the input of predicates.
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

// Reads the variable of a check, divided by powers of other variables, at the points that "where" selects.
// All members throw InputError for a name that the
// result does not have.
class CheckedCurves {
 public:
  // Keeps references to the result and the check. side: 0 or 1, the value of "compare" at which to measure;
  // none for a check without "compare".
  CheckedCurves(const results::ResultReader& result, const Check& check,
                std::optional<std::size_t> side = {});

  // Returns the curves along the check's dimension. The abscissa is this axis or the check's variable x.
  Curves along() const;
  // Returns the curves along `dimension`, with the same choice of the abscissa as along().
  Curves along(const std::string& dimension) const;
  // Returns the curves along the check's dimension that have values at the first and at the last selected
  // point. Other curves do not show a change from end to end.
  Curves from_end_to_end() const;
  // Returns all selected points in row-major order, including points without a value.
  Curve points() const;

 private:
  CheckedField field_of(const std::string& variable) const;
  Curves curves(const std::string& dimension, bool whole) const;

  const results::ResultReader& result_;
  const Check& check_;
  std::optional<std::size_t> side_;
};

}  // namespace bristle::claims
