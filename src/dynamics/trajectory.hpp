#pragma once

#include "dynamics/passage.hpp"

namespace bristle {

// What a tip does at an instant, as Fig. 2 marks it. The first that applies.
enum class Phase {
  off_slab,   // rebound: more than kOffSlabRanges ranges of the wall below the slab
  stick,      // V_R below V_s, the static branch of chi
  side_slip,  // V_R turned away from the slab's motion by more than kSideSlip
  slip
};
constexpr double kOffSlabRanges = 10;             // of lambda_z: F_n is then below 0.03
constexpr double kSideSlip = 0.5235987755982988;  // rad (30 deg)

// A passage after each step. Dimensionless; forces as the slab feels them.
struct TrajectoryPoint {
  double xi;
  OdeState y;  // state and integrals, see Component
  double F_n, F_fx, F_fy, V_R;
  Phase phase;
};
struct Trajectory {
  Passage passage;
  std::vector<TrajectoryPoint> points;
};

Trajectory record_trajectory(const PassageTask& task);

}  // namespace bristle
