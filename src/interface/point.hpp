#pragma once

#include "interface/ensemble.hpp"
#include "interface/load.hpp"

#include <optional>

namespace bristle {

// What is asked of one point of a sweep: a gap, or a load to find the gap for. Dimensionless, per N_c0.
struct Loading {
  std::optional<double> z_0;
  double R_n = 2;
  LoadPath path = LoadPath::loading;
};

enum class PointStatus {
  ok,
  jump,          // R_n(z_0) jumps across the target: the values are those of the far side
  unreachable,   // no gap carries the target: no values
  incomplete,    // a passage ended without an exit: no values
  not_converged  // values, but an error above rtol
};

// Everything known of one point. Values are NaN where the status says that there are none.
// Errors: quadrature over theta_0, and, where z_0 was searched for, the load's distance from its target.
struct PointResult {
  PointStatus status = PointStatus::ok;
  double z_0 = 0, z_0_error = 0;
  ObservableArray value{}, error{};
  double R_x_norm = 0, R_x_norm_error = 0;  // Eqs. (20, 21), at the R_n actually carried
  double R_y_norm = 0, R_y_norm_error = 0;
  double jump_z_0 = 0, jump_R_n = 0;  // last gap before the jump and its R_n; NaN without
  double incomplete_theta_0 = 0;      // rad; NaN if complete
  long passages = 0;                  // bristles integrated for this point
};

// Where the status is ok and a load was asked for, R_n is within orientation.rtol of it. bristles, if given,
// receives the passages at the gap that the values are of. run computes the passages; the result does not
// depend on how.
PointResult solve_point(const Interface& interface, const Loading& loading, const PassageRunner& run,
                        std::vector<Passage>* bristles = nullptr);

}  // namespace bristle
