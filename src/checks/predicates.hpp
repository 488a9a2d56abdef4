#pragma once

#include "results/reader.hpp"

namespace bristle {

// A measured number, with what the stored error estimates leave open: the truth lies in
// value +- uncertainty as far as they are right.
struct Measurement {
  double value, uncertainty;
  std::size_t curves = 0;   // that went in
  std::size_t missing = 0;  // points without a value, left out
};

// A variable with its errors, cut into curves along one of its dimensions.
struct Curves {
  struct Point {
    double value, error;
  };
  std::vector<std::vector<Point>> curves;
  std::size_t missing = 0;
};

// Throws InputError if the result has no such variable or dimension. Points whose value is not finite
// are left out and counted.
Curves curves_along(const ResultReader& result, const std::string& variable, const std::string& along);

// Kendall's tau pooled over the curves: rising less falling pairs of points, over all pairs. A pair whose
// errors overlap counts as neither and widens the uncertainty. -1: falls everywhere, 1: rises.
Measurement trend(const Curves& curves);

// Last over first value along the axis, geometric mean over the curves.
Measurement end_ratio(const Curves& curves);

// Mean range of ln(variable) along one axis over that along another. Dimensionless.
Measurement range_ratio(const Curves& along, const Curves& against);

}  // namespace bristle
