#pragma once

#include <limits>

namespace bristle {

// One unit of each dimensionless quantity, in SI units; NaN if it is not known.
struct SiScales {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  double length = kNone;     // r0, m
  double velocity = kNone;   // V0, m/s
  double energy = kNone;     // m V0^2, J, and torsional stiffness, N m/rad
  double force = kNone;      // m V0^2/r0, N
  double stiffness = kNone;  // m V0^2/r0^2, N/m
  double stress = kNone;     // m V0^2/r0^3, Pa
};

}  // namespace bristle
