#pragma once

#include "model/equations.hpp"
#include "util/words.hpp"

namespace bristle {

template <class T>
struct State;  // model/equations.hpp

// Position of a tip in the vertical plane theta = theta_0. r dimensionless, phi in rad.
struct Equilibrium {
  double r, phi;
};

// Frictionless static equilibrium in the vertical plane theta = theta_0: the minimum of the potential energy
// over (r, phi) with 0 < phi <= phi_0 that is reached from the undeformed bristle as the slab comes down from
// first contact to the gap of b. Throws std::runtime_error if at some gap on this way there is no equilibrium
// (parameters far outside the physical ranges).
Equilibrium static_equilibrium(const Bristle<double>& b);

// Position of a bristle at the leading edge of a slab with the gap z_0, as Parameters::initial_state
// specifies. Throws std::runtime_error like static_equilibrium().
Equilibrium initial_state(const Parameters& p, double z_0);

// How a bristle yields to a slab that comes down from first contact to the ground. It depends on k_r/k_phi
// and phi_0; which of both a curve over the stiffness has may change along it.
enum class Start {
  bent,         // it bends down
  crushed,      // it is compressed upright
  undetermined  // the initial state does not follow the slab
};
template <>
inline Words words<Start>() {
  static constexpr const char* list[] = {"bent", "crushed", "undetermined"};
  return list;
}
Start start_of(const Parameters& p);

// State of the bristle at rest at this position, with the azimuth theta_0 of b.
State<double> state_at_rest(const Bristle<double>& b, const Equilibrium& e);

}  // namespace bristle
