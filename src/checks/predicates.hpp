#pragma once

#include "checks/curves.hpp"

#include <limits>

namespace bristle {

// A measured number, with what the stored error estimates leave open: the truth lies in value +- uncertainty
// as far as they are right.
struct Measurement {
  double value = std::numeric_limits<double>::quiet_NaN();
  double uncertainty = std::numeric_limits<double>::quiet_NaN();
  std::size_t curves = 0;                                          // that went in
  std::size_t missing = 0;                                         // points without a value, left out
  double significance = std::numeric_limits<double>::quiet_NaN();  // of a rank correlation: two-sided p
};

// Kendall's tau pooled over the curves: rising less falling pairs of points, over all pairs. A pair whose
// errors overlap, in the value or the abscissa, counts as neither and widens the uncertainty. -1: falls
// everywhere, 1: rises.
Measurement trend(const Curves& curves);

// Kendall's tau between two quantities on the same points: 1 if they rise and fall together.
Measurement concordance(const Curve& first, const Curve& second);

// Last over first value along the axis, geometric mean over the curves.
Measurement end_ratio(const Curves& curves);

// Mean range of ln(variable) along one axis over that along another.
Measurement range_ratio(const Curves& along, const Curves& against);

// Slope of the straight line through ln(value) over ln(abscissa) by least squares, or of value over abscissa;
// mean over the curves.
Measurement slope(const Curves& curves, bool logarithmic);

// Largest less smallest value over the mean value; mean over the curves.
Measurement plateau(const Curves& curves);

// Mean value over all points.
Measurement level(const Curves& curves);

// Abscissa at which ln(value) falls most steeply over ln(abscissa), in the middle between neighbouring
// points; their distance, and that of all whose slope cannot be told from it, is the uncertainty. Mean over
// the curves.
Measurement steepest_fall(const Curves& curves);

// That steepest slope, as a positive number.
Measurement steepness(const Curves& curves);

// ln of the ratio of the abscissas at which a falling curve has come down a quarter and three quarters of its
// range; the distances of the points there are the uncertainty.
Measurement fall_width(const Curves& curves);

// Largest drop of the value below what it was before along the curve, over that; the largest of all curves.
Measurement fold(const Curves& curves);

// Share of the points at which first is greater than second, less that at which it is smaller. Points whose
// errors overlap count as neither and widen the uncertainty.
Measurement ordering(const Curve& first, const Curve& second);

// Root mean square of (first - second) over the error of the difference; its own uncertainty is that of as
// many random deviates. Infinite uncertainty where the mean error exceeds resolution: agreement then means
// nothing.
Measurement equality(const Curve& first, const Curve& second, double resolution);

}  // namespace bristle
