#include "bristle/dynamics/trajectory.hpp"

#include "bristle/dynamics/ode.hpp"
#include "bristle/model/elementary.hpp"

namespace bristle {
namespace {

using namespace component;

Phase phase_of(const Bristle<double>& b, const State<double>& state, const Sliding<double>& sliding) {
  if (is_off_slab(b, state.r[2])) return Phase::off_slab;
  if (sliding.V_R < b.V_s) return Phase::stick;
  return -sliding.e_x < cos(kSideSlip) ? Phase::side_slip : Phase::slip;
}

// Returns the angle from the in-plane position a to the in-plane position b, in (-pi, pi], rad.
double angle_between(const OdeState& a, const OdeState& b) {
  const double cross = a[X] * b[Y] - a[Y] * b[X], dot = a[X] * b[X] + a[Y] * b[Y];
  const double half_turn = dot >= 0 ? 0 : cross >= 0 ? M_PI : -M_PI;
  return cross == 0 ? half_turn : half_turn + atan(cross / dot);
}

// Returns the state y with the azimuth and the polar angle of its position, which a rod's own state lacks.
// The azimuth is unwrapped from the state before.
OdeState with_angles(OdeState y, const OdeState& before) {
  y[THETA] = before[THETA] + angle_between(before, y);
  y[PHI] = asin(y[Z] / std::sqrt(y[X] * y[X] + y[Y] * y[Y] + y[Z] * y[Z]));
  return y;
}

}  // namespace

Trajectory record_trajectory(const PassageTask& task) {
  Trajectory out;
  out.passage = run_passage(task, [&](double xi, const OdeState& y) {
    const auto state = unpack<double>(y);
    const auto [acceleration, rates, contact, sliding, friction] = motion(task.bristle, state);
    const bool has_angles = has_pole(task.bristle.bending) || out.points.empty();
    const OdeState shown = has_angles ? y : with_angles(y, out.points.back().y);
    out.points.push_back({xi, shown, contact.F_n, friction[0], friction[1], sliding.V_R,
                          phase_of(task.bristle, state, sliding)});
  });
  return out;
}

}  // namespace bristle
