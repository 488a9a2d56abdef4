#pragma once

#include "dynamics/trajectory.hpp"
#include "ensemble/ensemble.hpp"
#include "ensemble/lattice.hpp"
#include "ensemble/load.hpp"

#include <optional>

namespace bristle {

// The whole curve R_n(z_0) instead of a point of it: see trace.hpp.
struct Trace {
  double to = 0.01;          // lowest gap; the highest is first contact
  double resolution = 0.02;  // relative, of R_n between neighbouring nodes
  long nodes = 256;          // at most
};

// What is asked of one point of a sweep: a gap, a load to find the gap for, or a curve. Dimensionless, per
// N_c0.
struct Loading {
  std::optional<double> z_0;
  double R_n = 2;
  LoadPath path = LoadPath::loading;
  std::optional<Trace> trace{};
};

enum class PointStatus {
  ok,
  load_jump,      // R_n(z_0) jumps across the target: the values are those of the far side
  unreachable,    // no gap carries the target: no values
  incomplete,     // a passage ended without an exit: no values
  not_converged,  // values, but an error above rtol
  absent          // a curve has fewer nodes than this
};

// Everything known of one point. Values are NaN where the status says that there are none.
// Errors: quadrature over theta_0, and, where z_0 was searched for, the load's distance from its target.
struct PointResult {
  PointStatus status = PointStatus::ok;
  double z_0 = 0, z_0_error = 0;
  ObservableArray value{}, error{};
  ObservableArray load_error{};  // the part of error that the load's distance from its target makes
  Fluctuation fluctuation, fluctuation_of_rows;  // on a lattice; NaN otherwise
  double R_x_norm = 0, R_x_norm_error = 0;       // Eqs. (20, 21), at the R_n actually carried
  double R_y_norm = 0, R_y_norm_error = 0;
  double R_x_norm_load_error = 0, R_y_norm_load_error = 0;
  double jump_z_0 = 0, jump_R_n = 0;  // last gap before the jump and its R_n; NaN without
  double incomplete_theta_0 = 0;      // rad; NaN if complete
  long passages = 0;                  // bristles integrated for this point
  double force_unit = 0;              // newtons per dimensionless force, where there are SI units
};

// What is kept of a point beside its values.
struct Recording {
  bool bristles = false, slab_force = false;
  std::vector<double> trajectories;  // theta_0, rad
};
// It, at the gap that the values are of.
struct Recorded {
  std::vector<Passage> bristles;
  SlabForce slab_force;
  std::vector<Trajectory> trajectories;
};

// Where the status is ok and a load was asked for, R_n is within orientation.rtol of it; on a lattice the gap
// is the one at which the mean over theta_0 carries the load. run computes the passages; the result does not
// depend on how. recorded must be given where something is to be kept.
PointResult solve_point(const Setup& setup, const Loading& loading, const PassageRunner& run,
                        const Recording& record = {}, Recorded* recorded = nullptr);

// The values of a mean at its gap, with the status that follows from it.
PointResult values_of(const Parameters& parameters, const Ensemble& ensemble);

}  // namespace bristle
