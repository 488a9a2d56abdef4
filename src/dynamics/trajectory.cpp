#include "dynamics/trajectory.hpp"

#include "dynamics/ode.hpp"
#include "model/elementary.hpp"

namespace bristle {
namespace {

Phase phase_of(const Parameters& p, const Bristle<double>& b, const State<double>& state,
               const Sliding<double>& sliding) {
  if (b.z_0 - state.r[2] > kOffSlabRanges * p.lambda_z) return Phase::off_slab;
  if (sliding.V_R < p.V_s) return Phase::stick;
  return -sliding.e_x < cos(kSideSlip) ? Phase::side_slip : Phase::slip;
}

}  // namespace

Trajectory record_trajectory(const PassageTask& task) {
  Trajectory out;
  out.passage = run_passage(task, [&](double xi, const OdeState& y) {
    const auto state = unpack<double>(y);
    const auto [acceleration, rates, wall, sliding, friction] = motion(task.bristle, state);
    out.points.push_back({xi, y, wall.F_n, friction[0], friction[1], sliding.V_R,
                          phase_of(*task.parameters, task.bristle, state, sliding)});
  });
  return out;
}

}  // namespace bristle
