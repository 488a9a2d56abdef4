#pragma once

#include "model/parameters.hpp"

namespace bristle {

// Steady sliding: the tip rests at the distance r from its root and at the polar angle phi (rad) while the slab moves
// over it. A small disturbance changes as exp((growth_rate + i frequency) xi) in its least stable mode.
// Dimensionless; NaN if a bristle cannot rest.
struct SteadySliding {
  double r, phi, F_n, growth_rate, frequency;
};

// Returns the steady sliding of a bristle that points along the motion, theta_0 = 0, under a slab at the gap z_0
// (dimensionless), and its linear stability. It is a fixed point of Eqs. (13, 17, 18), which is followed from first
// contact down to z_0.
SteadySliding steady_sliding(const Parameters& p, double z_0);

}  // namespace bristle
