#pragma once

#include "bristle/dynamics/ode.hpp"
#include "bristle/model/friction/table.hpp"

#ifdef __aarch64__
// Eigen's vectors of two doubles would use fused multiply-add on ARM only, and round differently.
#include <arm_neon.h>
#undef __ARM_FEATURE_FMA
#endif
#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

// Functions that Eigen's AutoDiffScalar lacks.
namespace Eigen {
template <class D>
AutoDiffScalar<typename internal::remove_all<D>::type::PlainObject> atan(const AutoDiffScalar<D>& u) {
  const double x = u.value();
  return {bristle::atan(x), u.derivatives() * (1.0 / (1.0 + x * x))};
}
// Overrides Eigen's function, which calls std::sin.
template <int N>
AutoDiffScalar<Matrix<double, N, 1>> sin(const AutoDiffScalar<Matrix<double, N, 1>>& u) {
  return {bristle::sin(u.value()), u.derivatives() * bristle::cos(u.value())};
}
template <class D>
AutoDiffScalar<D> inverse_sqrt(const AutoDiffScalar<D>& u) {
  const double y = bristle::inverse_sqrt(u.value());
  return {y, u.derivatives() * (-0.5 * y * y * y)};
}
template <class D>
AutoDiffScalar<D> decay(const AutoDiffScalar<D>& u) {
  const double y = bristle::decay(u.value());
  return {y, u.derivatives() * y};
}
template <class D>
AutoDiffScalar<D> interpolated(const bristle::ModulationTable& table, const AutoDiffScalar<D>& u) {
  return {table.at(u.value()), u.derivatives() * table.slope(u.value())};
}
}  // namespace Eigen

namespace bristle {

// Derivatives of the slope of each component by each component of the state.
using Jacobian = std::array<std::array<double, kState>, COMPONENTS>;

// Computes the Jacobian of derivative() by automatic differentiation.
inline void jacobian(const Bristle<double>& b, const OdeState& y, Jacobian& out) {
  using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, kState, 1>>;
  std::array<Dual, kState> in;
  std::array<Dual, COMPONENTS> slopes;
  for (int i = 0; i < kState; ++i) in[i] = Dual(y[i], kState, i);
  derivative<Dual>(b, in, slopes);
  for (int i = 0; i < COMPONENTS; ++i)
    for (int j = 0; j < kState; ++j) out[i][j] = slopes[i].derivatives()[j];
}

}  // namespace bristle
