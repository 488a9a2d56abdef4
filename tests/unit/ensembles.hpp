#pragma once

#include "bristle/ensemble/ensemble.hpp"
#include "bristle/ensemble/point.hpp"
#include "bristle/model/friction/laws.hpp"

namespace bristle::testing {

// The paper's parameters with this k_r, and this tolerance of the means.
inline Setup paper(double k_r, double rtol = 1e-3) {
  Setup i;
  i.parameters.k_r = k_r;
  i.parameters.C = chi_C_peak_at_V_s(i.parameters.A);
  i.orientation.rtol = rtol;
  return i;
}

inline Ensemble ensemble_mean(const Setup& setup, double z_0) {
  return EnsembleMean(setup, z_0, make_runner(Engine::fast)).full();
}

inline PointResult solve(const Setup& setup, const Loading& loading) {
  return solve_point(setup, loading, make_runner(Engine::fast));
}

}  // namespace bristle::testing
