#pragma once

#include "bristle/dynamics/passage.hpp"
#include "bristle/words.hpp"

namespace bristle {

// Phase of the tip's motion, as marked in Fig. 2: the first phase in this list whose condition holds.
enum class Phase {
  off_slab,   // rebound: is_off_slab()
  stick,      // V_R below V_s, the static branch of chi
  side_slip,  // angle between V_R and the slab's motion above kSideSlip
  slip
};
template <>
inline Words words<Phase>() {
  static constexpr const char* list[] = {"off_slab", "stick", "side_slip", "slip"};
  return list;
}
constexpr double kSideSlip = 0.5235987755982988;  // rad (30 deg)

// State and forces on the slab at the start, after each step or at the exit. Dimensionless.
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
