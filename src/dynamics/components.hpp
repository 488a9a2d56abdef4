#pragma once

#include <array>

namespace bristle {

// Components of the initial value problem of one passage: the tip's state, then integrals over the local time
// xi from 0, on which no force depends. Dimensionless.
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
  FRICTION_X,  // F_fx on the slab: the component that opposes its motion
  FRICTION_Y,
  MODULATION,  // F_n modulation, numerator of Eq. (24)
  ALIGNMENT,   // -F_n e_f.i, numerator of Eq. (25)
  AREA,        // F_n^(2/3), numerator of Eq. (26)
  WORK,        // power(), the right-hand side of the energy balance
  COMPONENTS
};
constexpr int kState = NORMAL;  // number of components on which forces depend
constexpr int kIntegrals = COMPONENTS - NORMAL;

// The error of a step may be rtol |y| + atol tolerance_scale(component).
constexpr double tolerance_scale(int component) { return VX <= component && component <= VZ ? 0.1 : 1; }

using OdeState = std::array<double, COMPONENTS>;

}  // namespace bristle
