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

Derived mean_of_passing(const PointResult& p, Observable contribution) {
  const double passing = 1 - p.value[PINNED_FRACTION], value = p.value[contribution] / passing;
  return {value, (p.error[contribution] + value * p.error[PINNED_FRACTION]) / passing,
          (p.load_error[contribution] + value * p.load_error[PINNED_FRACTION]) / passing};
}

Derived friction_of_passing(const PointResult& p) {
  const double R_rigid = p.value[R_X] / p.R_x_norm, share = p.value[PASSING_R_X] / p.value[R_X];
  const double of_load = p.R_x_norm_error - p.error[R_X] / R_rigid;  // error by that of R_n in R_rigid
  return {share * p.R_x_norm, p.error[PASSING_R_X] / R_rigid + share * of_load,
          p.load_error[PASSING_R_X] / R_rigid};
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
