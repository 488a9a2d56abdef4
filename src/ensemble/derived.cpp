#include "ensemble/derived.hpp"

#include "model/elementary.hpp"

#include <cmath>
#include <limits>

namespace bristle {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Derived share_of(const PointResult& p, Observable part, Observable total) {
  const double value = p.value[part] / p.value[total];
  return {value, (p.error[part] + value * p.error[total]) / p.value[total],
          (p.load_error[part] + value * p.load_error[total]) / p.value[total]};
}

Derived friction_coefficient(const PointResult& p) {
  const double value = p.value[R_X] / p.value[R_N];
  return {value, (p.error[R_X] + std::abs(value) * p.error[R_N]) / p.value[R_N], kUnknown};
}

Derived friction_magnitude(const PointResult& p) {
  const double value = std::sqrt(p.R_x_norm * p.R_x_norm + p.R_y_norm * p.R_y_norm);
  const double error =
      (std::abs(p.R_x_norm) * p.R_x_norm_error + std::abs(p.R_y_norm) * p.R_y_norm_error) / value;
  return {value, error, kUnknown};
}

Derived friction_direction(const PointResult& p) {
  const double x = p.value[R_X], y = p.value[R_Y];  // x is positive: friction opposes the motion
  const double error = (std::abs(y) * p.error[R_X] + std::abs(x) * p.error[R_Y]) / (x * x + y * y);
  return {atan(y / x) * (180 / M_PI), error * (180 / M_PI), kUnknown};
}

}  // namespace bristle
