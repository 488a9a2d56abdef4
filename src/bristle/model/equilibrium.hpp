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

// Returns the frictionless static equilibrium in the vertical plane theta = theta_0: the minimum of the
// potential energy over (r, phi) with 0 < phi <= phi_0 that is reached from the undeformed bristle as the
// slab comes down from first contact to the gap b.z_0. Throws ModelError if at some gap on this way there is
// no equilibrium (parameters far outside the physical ranges).
Equilibrium static_equilibrium(const Bristle<double>& b);

// How a bristle yields to a slab that comes down from first contact to the ground. The outcome depends on
// k_r/k_phi and phi_0, so it may change along a sweep over the stiffness.
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
// the bristle does under a slab that comes down slowly: soft bristles have two minima under the slab. The
// steps are common to all gaps and are computed once.
class FollowedMinimum {
 public:
  // Takes the bristle b, whose z_0 does not matter. at_slab: the tip is held at z = z_0 instead of being
  // pushed by the contact force.
  FollowedMinimum(const Bristle<double>& b, bool at_slab) : bristle_(b), at_slab_(at_slab) {}

  // Returns the polar angle at the gap z_0, rad; NaN if there is no minimum at a gap on the way.
  double phi(double z_0);

 private:
  struct Step {
    double z_0, phi, z;  // z: a guess of the tip's height at the next step
  };
  // Returns the minimum at the gap z_0 that is downhill from the minimum `from` at another gap.
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

  // Returns the position at the gap z_0. Throws ModelError like static_equilibrium().
  Equilibrium at(double z_0);
  // Returns how the bristle yields on the way down to the ground.
  Start start();

 private:
  const Parameters& p_;
  FollowedMinimum minimum_;
};

// Returns the state of the bristle b at rest at the position e, with the azimuth theta_0 of b.
State<double> state_at_rest(const Bristle<double>& b, const Equilibrium& e);

}  // namespace bristle
