#pragma once

#include "bristle/dynamics/dual.hpp"

namespace bristle {

// Derivatives of the slope of each component by each component of the state.
using Jacobian = std::array<std::array<double, kState>, COMPONENTS>;

// Computes the Jacobian of derivative() by automatic differentiation.
inline void jacobian(const Bristle<double>& b, const OdeState& y, Jacobian& out) {
  std::array<Dual, kState> in;
  std::array<Dual, COMPONENTS> slopes;
  for (int i = 0; i < kState; ++i) {
    in[i] = y[i];
    in[i].slopes[i] = 1;
  }
  derivative<Dual>(b, in, slopes);
  for (int i = 0; i < COMPONENTS; ++i) out[i] = slopes[i].slopes;
}

}  // namespace bristle
