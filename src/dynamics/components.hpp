#pragma once

#include <array>

namespace bristle {

// One passage as an initial value problem: the tip's state, then integrals along the way that no
// force depends on. Each integral is over local time xi from 0; dimensionless.
enum Component {
  X,
  Y,
  Z,
  VX,
  VY,
  VZ,
  THETA,
  PHI,
  NORMAL,      // F_n
  FRICTION_X,  // F_fx as the slab feels it: the component that opposes its motion
  FRICTION_Y,
  MODULATION,  // F_n modulation, numerator of Eq. (24)
  ALIGNMENT,   // -F_n e_f.i, numerator of Eq. (25)
  AREA,        // F_n^(2/3), numerator of Eq. (26)
  WORK,        // power(): the energy budget's right-hand side
  COMPONENTS
};
constexpr int kState = NORMAL;  // components that forces depend on
constexpr int kIntegrals = COMPONENTS - NORMAL;

using OdeState = std::array<double, COMPONENTS>;

}  // namespace bristle
