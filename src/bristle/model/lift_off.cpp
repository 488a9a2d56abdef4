#include "bristle/model/lift_off.hpp"

#include "bristle/model/elementary.hpp"
#include "bristle/model/friction/laws.hpp"
#include "bristle/message.hpp"

#include <array>
#include <limits>

namespace bristle {
namespace {

double fitted_load(const Parameters& p) {
  return kLiftOff.of_springs * std::sqrt(p.k_r * p.k_phi) - kLiftOff.of_speed * p.k_phi * log(p.k_phi);
}

// Range of a quantity in which the fit was tested.
struct Tested {
  LiftOffDomain outside;
  const char* name;
  double (*value)(const Parameters&);
  double from, to;
};
constexpr std::array kTested = {
    Tested{LiftOffDomain::k_phi, "k_phi", [](const Parameters& p) { return p.k_phi; }, 0.5, 10},
    Tested{LiftOffDomain::k_r_over_k_phi, "k_r/k_phi", [](const Parameters& p) { return p.k_r / p.k_phi; }, 4,
           36},
    // Loads below this range change gradually; loads above it are more than any other gap carries.
    Tested{LiftOffDomain::load_over_k_phi, "the lift-off load over k_phi",
           [](const Parameters& p) { return fitted_load(p) / p.k_phi; }, 0.5, 2.3},
    Tested{LiftOffDomain::local_friction, "the friction coefficient of rigid bristles at the lift-off load",
           [](const Parameters& p) {
             const double load = fitted_load(p);
             return with_law(p.friction, [&](auto law) { return law.rigid(p, load); }) / load;
           },
           3, 20},
    Tested{LiftOffDomain::L_x, "L_x", [](const Parameters& p) { return p.L_x; }, 5, 16},
    Tested{LiftOffDomain::phi_0, "phi_0_deg", [](const Parameters& p) { return p.phi_0 * 180 / M_PI; }, 75,
           86},
    Tested{LiftOffDomain::zeta_phi, "zeta_phi", [](const Parameters& p) { return p.zeta_phi; }, 0.05, 0.3},
};

}  // namespace

LiftOffDomain lift_off_domain(const Parameters& p) {
  if (p.bending == Bending::rod && p.section == Section::oval) return LiftOffDomain::section;
  for (const Tested& tested : kTested) {
    const double value = tested.value(p), rounding = 1e-9 * tested.to;
    if (!(value >= tested.from - rounding && value <= tested.to + rounding)) return tested.outside;
  }
  return LiftOffDomain::tested;
}

std::string outside_of(LiftOffDomain domain) {
  if (domain == LiftOffDomain::section) return "rods are oval";
  for (const Tested& tested : kTested)
    if (tested.outside == domain)
      return message(tested.name, " is outside ", all_digits(tested.from), " to ", all_digits(tested.to));
  return "";
}

double lift_off_load(const Parameters& p) {
  return lift_off_domain(p) == LiftOffDomain::tested ? fitted_load(p)
                                                     : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace bristle
