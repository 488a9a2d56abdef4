#pragma once

#include "bristle/model/parameters.hpp"

#include <cmath>

namespace bristle {

// A small disturbance changes as exp((growth_rate + i frequency) xi). Dimensionless.
struct Mode {
  double growth_rate, frequency;
};

// Steady sliding: the tip rests at the distance r from its root and at the polar angle phi (rad) while the
// slab moves over it under F_n. in_plane is the least stable mode in the vertical plane of the motion,
// transverse the least stable mode across it; by symmetry they do not couple. Dimensionless; NaN if a bristle
// cannot rest.
struct SteadySliding {
  double r = NAN, phi = NAN, F_n = NAN;
  Mode in_plane = {NAN, NAN}, transverse = {NAN, NAN};
};

// Returns the steady sliding of a bristle that points along the motion, theta_0 = 0, under a slab at the gap
// z_0 (dimensionless), and its linear stability. It is a fixed point of Eqs. (13, 17, 18), which is followed
// from first contact down to z_0.
SteadySliding steady_sliding(const Parameters& p, double z_0);

}  // namespace bristle
