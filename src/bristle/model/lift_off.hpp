#pragma once

#include "bristle/model/parameters.hpp"
#include "bristle/words.hpp"

#include <string>

namespace bristle {

// Lift-off (docs/lift-off.md): the tips of a brush stay on the slab under loads above the lift-off load, and
// bounce under loads below it.

// The lift-off load R_n*/N_c0 = of_springs (k_r k_phi)^(1/2) - of_speed k_phi ln(k_phi), dimensionless. It is
// a fit to 603 computed maxima of R_n(z_0) among bouncing bristles; scatter is the root mean square of their
// relative distances from the fit. The first term does not depend on the slab's speed; k_phi is proportional
// to V_0^-2.
struct LiftOffFit {
  double of_springs, of_speed, scatter;
};
constexpr LiftOffFit kLiftOff = {0.346, 0.154, 0.09};

// States that the fit was tested for a brush, or names the first quantity that lies outside the range of the
// tests.
enum class LiftOffDomain {
  tested,
  section,
  k_phi,
  k_r_over_k_phi,
  load_over_k_phi,
  local_friction,
  L_x,
  phi_0,
  zeta_phi
};
template <>
inline Words words<LiftOffDomain>() {
  static constexpr const char* list[] = {"tested",          "section",        "k_phi", "k_r_over_k_phi",
                                         "load_over_k_phi", "local_friction", "L_x",   "phi_0",
                                         "zeta_phi"};
  return list;
}

// Returns whether the fit was tested for bristles with the parameters p.
LiftOffDomain lift_off_domain(const Parameters& p);

// Returns why the fit was not tested, such as "L_x is outside 5 to 16"; empty if it was.
std::string outside_of(LiftOffDomain domain);

// Returns the lift-off load R_n*/N_c0 of bristles with the parameters p, dimensionless; NaN where the fit was
// not tested.
double lift_off_load(const Parameters& p);

}  // namespace bristle
