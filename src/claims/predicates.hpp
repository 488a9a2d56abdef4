#pragma once

#include "bristle/quantity.hpp"
#include "claims/check.hpp"
#include "claims/curves.hpp"

#include <limits>

namespace bristle::claims {

// A measured number. If the error estimates in the result are correct, the true number lies within value +-
// error.
struct Measurement : Quantity {
  Measurement()
      : Quantity{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()} {}
  std::size_t curves = 0;   // number of curves measured on
  std::size_t missing = 0;  // points without a value, which are omitted
  double significance = std::numeric_limits<double>::quiet_NaN();  // two-sided p-value of a rank correlation
};

// Returns Kendall's tau pooled over the curves: (rising - falling pairs of points)/(all pairs). A pair whose
// errors overlap, in the value or the abscissa, counts as neither and increases the uncertainty. -1: all
// pairs fall, 1: all pairs rise. counted: all pairs, or only pairs within the sides of the jump, or across it
Measurement trend(const Curves& curves, PointPairs counted = PointPairs::all);

// Returns Kendall's tau between two quantities at the same points: 1 if they always rise and fall together.
Measurement concordance(const Curve& first, const Curve& second);

// Returns the ratio of the last to the first value along the axis; geometric mean over the curves.
Measurement end_ratio(const Curves& curves);

// Returns ln of the ratio of the last to the first value along the axis, positive if the values rise; mean
// over the curves.
Measurement rise(const Curves& curves);

// Returns the rise of ln(value) over the rise of ln(abscissa), both from the first to the last point and
// summed over the curves: the share of a factor in the change of its product.
Measurement share(const Curves& curves);

// Returns the geometric mean of the values in the last third of the points over the geometric mean in the
// first third; geometric mean over the curves.
Measurement third_ratio(const Curves& curves);

// Returns the root mean square distance of the values from their least-squares line over the abscissa,
// divided by the range of the line; mean over the curves with at least three points.
Measurement linearity(const Curves& curves);

// Returns the ratio of the largest to the first value along the axis; geometric mean over the curves.
Measurement top_ratio(const Curves& curves);

// Returns the ratio of the mean range of ln(variable) along one axis to the mean range along another axis.
Measurement range_ratio(const Curves& along, const Curves& against);

// Returns the slope of the least-squares line of ln(value) over ln(abscissa), or of value over abscissa; mean
// over the curves.
Measurement slope(const Curves& curves, bool logarithmic);

// Returns (largest - smallest value)/(mean value); mean over the curves.
Measurement plateau(const Curves& curves);

// Returns the mean value over all points.
Measurement level(const Curves& curves);

// Returns the abscissa at which ln(value) falls most steeply over ln(abscissa): the geometric mean of two
// neighbouring points. The uncertainty is the distance to the farthest point of any interval whose slope
// agrees with the steepest one within the errors. Mean over the curves.
Measurement steepest_fall(const Curves& curves);

// Returns the steepest slope -d ln(value)/d ln(abscissa); mean over the curves.
Measurement steepness(const Curves& curves);

// Returns ln of the ratio of the abscissas at which a falling curve has fallen by three quarters and by one
// quarter of its range. The uncertainty follows from the spacing of the points there. Mean over the curves.
Measurement fall_width(const Curves& curves);

// Returns the largest relative drop of the value below an earlier maximum as the abscissa falls; the largest
// of all curves. The uncertainty contains what the curve may do between the points.
Measurement fold(const Curves& curves);

// Returns the fraction of the points at which first is greater than second, minus the fraction at which first
// is smaller. Points whose errors overlap count as neither and increase the uncertainty.
Measurement ordering(const Curve& first, const Curve& second);

// Returns the root mean square of (first - second)/(error of the difference). The uncertainty is the standard
// error of the root mean square of equally many normal deviates; it is infinite if the mean error exceeds
// resolution, because agreement would then be meaningless.
Measurement equality(const Curve& first, const Curve& second, double resolution);

}  // namespace bristle::claims
