#pragma once

#include "bristle/dynamics/trajectory.hpp"
#include "bristle/ensemble/ensemble.hpp"
#include "bristle/ensemble/lattice.hpp"
#include "bristle/ensemble/load.hpp"
#include "bristle/model/si_scales.hpp"
#include "bristle/quantity.hpp"
#include "bristle/words.hpp"

#include <array>
#include <optional>

namespace bristle {

// Loading of a sweep point: a gap or a target load. Dimensionless, per N_c0.
struct Loading {
  std::optional<double> z_0{};
  double R_n = 2;
  LoadPath path = LoadPath::loading;
};

enum class PointStatus {
  ok,
  load_jump,      // R_n(z_0) jumps across the target: the values hold after the jump
  unreachable,    // no gap carries the target: no values
  incomplete,     // a passage ended without an exit: no values
  not_converged,  // there are values, but with an error above rtol
  undefined,      // some values or errors are NaN: they are ratios to a load or friction of zero
  failed,         // an error ended the computation: no values; the result has its message
  work_limit,     // integrator.max_evaluations_per_point was reached: no values
  ambiguous,      // there are values, but within the errors another crossing of the target may be the first
  inaccurate      // there are values, but the energy residual exceeds kMaxEnergyResidual
};
template <>
inline Words words<PointStatus>() {
  static constexpr const char* list[] = {
      "ok",        "load_jump", "unreachable", "incomplete", "not_converged",
      "undefined", "failed",    "work_limit",  "ambiguous",  "inaccurate"};
  return list;
}
// Largest energy residual of a trustworthy point, if its model conserves energy (conserves_energy()).
constexpr double kMaxEnergyResidual = 1e-2;

// Result of one sweep point. Values are NaN where the status says that there are none. Errors include the
// quadrature over theta_0, the integrator and, after a load search, the deviation of the load from its
// target.
struct PointResult {
  PointStatus status = PointStatus::ok;
  double z_0 = 0, z_0_error = 0;
  ObservableArray value{}, error{};
  ObservableArray load_error{};  // the part of error due to the deviation of the load from its target
  Quantity fluctuation, fluctuation_of_rows;  // for lattice sampling; NaN otherwise
  Quantity R_x_norm, R_y_norm;                // Eqs. (20, 21), for the computed R_n
  double jump_z_0 = 0, jump_R_n = 0;          // last gap before a jump, and its R_n; NaN without a jump
  Quantity R_n_largest;           // greatest load found where the target is unreachable; NaN elsewhere
  double z_0_of_R_n_largest = 0;  // its gap
  // The other gap of an ambiguous point (LoadPoint::z_0_other) and the values there; NaN without another gap.
  double z_0_other = 0, R_x_norm_other = 0;
  ObservableArray value_other{};
  Start start = Start::undetermined;
  double incomplete_theta_0 = 0;  // rad; NaN if complete
  long passages = 0;              // number of passages computed for this point
  Parameters parameters{};
  SiScales si{};
};

// Data to record in addition to the values of a point.
struct Recording {
  bool bristles = false, slab_force = false;
  std::vector<double> trajectories;  // theta_0, rad
};
// Recorded data, at the gap of the values.
struct Recorded {
  std::vector<Passage> bristles;
  SlabForce slab_force;
  std::vector<Trajectory> trajectories;
};

// Returns the result of a point without values. Throws nothing.
PointResult without_values(PointStatus status);

// Solves one sweep point. If the status is ok and a target load is given, R_n is within orientation.rtol of
// the target, or equal to it where the values have been moved to it by secants. With lattice sampling, the
// gap is the one at which the ensemble mean carries the target load. `run` computes the passages. `recorded`
// is required if `record` requests data.
PointResult solve_point(const Setup& setup, const Loading& loading, const PassageRunner& run,
                        const Recording& record = {}, Recorded* recorded = nullptr);

// Converts an ensemble mean to the result of a point with a given gap.
PointResult values_of(const Parameters& parameters, const Ensemble& ensemble);

}  // namespace bristle
