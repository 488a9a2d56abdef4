#include "bristle/ensemble/derived.hpp"

#include "bristle/model/elementary.hpp"

#include <cmath>
#include <limits>

namespace bristle {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
// Smallest fraction of the bristles that counts: the sum of the weights should be 1 and deviates by less than
// this.
constexpr double kNoFraction = 1e-12;

}  // namespace

Quantity pinned_share(const PointResult& p, Observable k) {
  const Observable part = pinned(k);
  const double value = p.value[part] / p.value[k];
  const double total = std::abs(p.value[k]);
  return {value, (p.error[part] + std::abs(value) * p.error[k]) / total,
          (p.load_error[part] + std::abs(value) * p.load_error[k]) / total};
}

Quantity unpinned_mean(const PointResult& p, Observable k) {
  const Observable part = unpinned(k);
  const double fraction = 1 - p.value[PINNED_FRACTION], value = p.value[part] / fraction;
  if (std::abs(fraction) < kNoFraction) return {kUnknown, kUnknown, kUnknown};
  return {value, (p.error[part] + std::abs(value) * p.error[PINNED_FRACTION]) / fraction,
          (p.load_error[part] + std::abs(value) * p.load_error[PINNED_FRACTION]) / fraction};
}

Quantity unpinned_friction(const PointResult& p) {
  const Observable part = unpinned(R_X);
  const double R_rigid = p.value[R_X] / p.R_x_norm.value, share = p.value[part] / p.value[R_X];
  const double of_load =
      p.R_x_norm.error - p.error[R_X] / R_rigid;  // the part of the error that R_n causes in R_rigid
  return {share * p.R_x_norm.value, p.error[part] / R_rigid + std::abs(share) * of_load,
          p.load_error[part] / R_rigid};
}

Quantity friction_coefficient(const PointResult& p) {
  const double value = p.value[R_X] / p.value[R_N];
  return {value, (p.error[R_X] + std::abs(value) * p.error[R_N]) / p.value[R_N], kUnknown};
}

Quantity drag(const PointResult& p) {
  constexpr Observable ENTRY_WORK = observable("entry_work");
  return {p.value[R_X] + p.value[ENTRY_WORK], p.error[R_X] + p.error[ENTRY_WORK],
          p.load_error[R_X] + p.load_error[ENTRY_WORK]};
}

Quantity impact_rate(const PointResult& p) {
  constexpr Observable IMPACTS_MEAN = observable("impacts");
  const double time = p.value[N_C_RATIO] * p.parameters.L_x, value = p.value[IMPACTS_MEAN] / time;
  const auto error = [&](const ObservableArray& of) {
    return of[IMPACTS_MEAN] / time + value * of[N_C_RATIO] / p.value[N_C_RATIO];
  };
  return {value, error(p.error), error(p.load_error)};
}

Quantity friction_magnitude(const PointResult& p) {
  const double value = std::sqrt(p.R_x_norm.value * p.R_x_norm.value + p.R_y_norm.value * p.R_y_norm.value);
  const double error =
      (std::abs(p.R_x_norm.value) * p.R_x_norm.error + std::abs(p.R_y_norm.value) * p.R_y_norm.error) / value;
  return {value, error, kUnknown};
}

Quantity friction_direction(const PointResult& p) {
  const double x = p.value[R_X], y = p.value[R_Y];
  const double error = (std::abs(y) * p.error[R_X] + std::abs(x) * p.error[R_Y]) / (x * x + y * y);
  // x is negative where the springs push the slab forward more than friction holds it back.
  const double angle = x < 0 ? atan(y / x) + std::copysign(M_PI, y) : atan(y / x);
  return {angle * (180 / M_PI), error * (180 / M_PI), kUnknown};
}

}  // namespace bristle
