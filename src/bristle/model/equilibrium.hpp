#pragma once

#include "bristle/model/equations.hpp"
#include "bristle/words.hpp"

#include <vector>

namespace bristle {

template <class T>
struct State;  // model/bristle.hpp

// Position of a tip in the vertical plane theta = theta_0. r dimensionless, phi in rad.
struct Equilibrium {
  double r, phi;
};

// Frictionless static equilibrium in the vertical plane theta = theta_0: the minimum of the potential energy
// over (r, phi) with 0 < phi <= phi_0 that is reached from the undeformed bristle as the slab comes down from
// first contact to the gap of b. Throws ModelError if at some gap on this way there is no equilibrium
// (parameters far outside the physical ranges).
Equilibrium static_equilibrium(const Bristle<double>& b);

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

// Follows the minimum of the energy from first contact, z_0 = sin(phi_0), down to a gap in small steps, as
// the polar angle of a bristle does under a slab that comes down slowly: soft bristles have two minima under
// the slab. The steps are common to all gaps and are computed once.
class FollowedMinimum {
 public:
  // At the slab: the tip is held at z = z_0 instead of being pushed by the wall. The gap of b does not
  // matter.
  FollowedMinimum(const Bristle<double>& b, bool at_slab) : bristle_(b), at_slab_(at_slab) {}

  // Polar angle, rad; NaN if there is no minimum at a gap on the way.
  double phi(double z_0);

 private:
  struct Step {
    double z_0, phi, z;  // z: a guess of the tip's height at the next step
  };
  // The minimum downhill from another gap's.
  Step minimum(double z_0, const Step& from) const;

  Bristle<double> bristle_;
  bool at_slab_;
  std::vector<Step> steps_;
};

// Positions of a bristle at the leading edge of a slab, as Parameters::initial_state specifies. The
// parameters must outlive the object.
class InitialStates {
 public:
  explicit InitialStates(const Parameters& p);

  // For the gap z_0. Throws ModelError like static_equilibrium().
  Equilibrium at(double z_0);
  Start start();

 private:
  const Parameters& p_;
  FollowedMinimum minimum_;
};

// State of the bristle at rest at this position, with the azimuth theta_0 of b.
State<double> state_at_rest(const Bristle<double>& b, const Equilibrium& e);

}  // namespace bristle
