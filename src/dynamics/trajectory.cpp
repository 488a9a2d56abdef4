#include "dynamics/trajectory.hpp"

#include "dynamics/ode.hpp"
#include "model/elementary.hpp"

namespace bristle {
namespace {

Phase phase_of(const Parameters& p, const Bristle<double>& b, const State<double>& state,
               const SlabContact<double>& slab) {
  if (b.z_0 - state.r[2] > kOffSlabRanges * p.lambda_z) return Phase::off_slab;
  if (slab.V_R < p.V_s) return Phase::stick;
  return -slab.e_x < cos(kSideSlip) ? Phase::side_slip : Phase::slip;
}

}  // namespace

Trajectory record_trajectory(const PassageTask& task) {
  Trajectory out;
  out.passage = run_passage(task, [&](double xi, const OdeState& y) {
    const auto state = unpack<double>(y);
    const SlabContact<double> slab = slab_contact(task.bristle, state);
    out.points.push_back({xi, y, slab.F_n, -slab.F_f * slab.e_x, -slab.F_f * slab.e_y, slab.V_R,
                          phase_of(*task.parameters, task.bristle, state, slab)});
  });
  return out;
}

}  // namespace bristle
