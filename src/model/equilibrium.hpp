#pragma once

#include "model/equations.hpp"

namespace bristle {

template <class T>
struct State;  // model/equations.hpp

// Frictionless static equilibrium in the vertical plane theta = theta_0: the minimum of the potential energy
// over (r, phi) with 0 < phi <= phi_0. Lengths dimensionless, phi in rad.
struct Equilibrium {
  double r, phi;
};

// Throws std::runtime_error if there is no equilibrium (parameters far outside the physical ranges).
Equilibrium static_equilibrium(const Bristle<double>& b);

// Position of a bristle at the leading edge of a slab with the gap z_0, as Parameters::initial_state
// specifies. Throws std::runtime_error like static_equilibrium().
Equilibrium initial_state(const Parameters& p, double z_0);

// State of the bristle at rest at this position, with the azimuth theta_0 of b.
State<double> state_at_rest(const Bristle<double>& b, const Equilibrium& e);

}  // namespace bristle
