#pragma once

#include "experiment/check.hpp"
#include "results/reader.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bristle {

// A value with its error estimate over an abscissa.
struct CurvePoint {
  double x, value, error;
  double x_error = 0;
};
using Curve = std::vector<CurvePoint>;

// Curves along one dimension of a result, on which a check measures.
struct Curves {
  std::vector<Curve> curves;
  std::size_t missing = 0;   // points without a value, left out
  bool independent = false;  // the errors are independent and add in quadrature, otherwise linearly
};

// A variable with its errors over the sweep; kept marks the selected points. All in row-major order.
struct CheckedField {
  std::vector<std::string> dimensions;
  std::vector<std::size_t> shape;
  std::vector<double> values, errors;
  std::vector<bool> kept;
};

// The variable of a check, divided by powers of others, at the points that its "where" selects. "at" reduces a
// traced curve to one value: by linear interpolation, at the node that carries the given load on the loading
// path (for another variable: where it first passes the given value); the error then includes the distance to
// the nearer node. All members throw InputError for a name that the result does not have.
class CheckedCurves {
 public:
  // at: of the check's comparison, the value of the axis at which to measure.
  CheckedCurves(const ResultReader& result, const Check& check, const std::optional<Selection>& at = {});

  // Curves along the check's dimension, or another, over that axis or the check's abscissa x.
  Curves along() const;
  Curves along(const std::string& dimension) const;
  // All selected points in row-major order, those without a value included.
  Curve points() const;

 private:
  CheckedField field_of(const std::string& variable) const;

  const ResultReader& result_;
  const Check& check_;
  std::optional<std::pair<std::string, Selection>> compared_;
};

}  // namespace bristle
