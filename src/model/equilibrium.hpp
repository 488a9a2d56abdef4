#pragma once

#include "model/bristle.hpp"

namespace bristle {

template <class T>
struct State;  // model/equations.hpp

// The frictionless static equilibrium in the vertical plane theta = theta_0: the point of least
// potential energy over (r, phi) with 0 < phi <= phi_0. Lengths dimensionless, phi in rad.
struct Equilibrium {
  double r, phi;
};

// Throws std::runtime_error if there is no equilibrium (parameters far outside the physical ranges).
Equilibrium static_equilibrium(const Bristle<double>& b);

// Where a bristle is at the leading edge of a slab at the gap z_0, by the parameters' initial_state. Throws
// std::runtime_error as static_equilibrium() does.
Equilibrium initial_state(const Parameters& p, double z_0);

// The bristle at rest in that equilibrium, at the azimuth theta_0 of b.
State<double> state_at_rest(const Bristle<double>& b, const Equilibrium& e);

}  // namespace bristle
