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

// Returns the parameters of the bristles p under a slab whose velocity is `speed` times V_0.
Parameters at_speed(Parameters p, double speed) {
  for (const auto member : {&Parameters::k_r, &Parameters::k_theta, &Parameters::k_phi, &Parameters::tau_f,
                            &Parameters::E_star, &Parameters::alpha, &Parameters::beta})
    p.*member /= speed * speed;
  p.V_s /= speed;
  p.custom_friction.V_0 *= speed;
  return p;
}

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

LiftOffSpeed lift_off_speed(const Parameters& p, double R_n) {
  // R_n/k_phi and k_r/k_phi do not depend on the speed.
  const double load = R_n / p.k_phi;
  const double above = load - kLiftOff.of_springs * std::sqrt(p.k_r / p.k_phi);
  const double speed = std::sqrt(p.k_phi) * exp(above / (2 * kLiftOff.of_speed));
  if (lift_off_domain(at_speed(p, speed)) != LiftOffDomain::tested) return {NAN, NAN};
  return {speed, exp(kLiftOff.scatter * load / (2 * kLiftOff.of_speed))};
}

double bouncing_load_by_statics(const Parameters& p, double z_0) {
  const double cos_phi = std::sqrt(1 - z_0 * z_0);
  const double a = (p.phi_0 - asin(z_0)) / cos_phi;
  // With r = 1 at both ends of the path over the root, from x = -X to X, the integral is z_0 (2 atanh(X) - 2
  // X). Half of the bristles take this path.
  constexpr int kNodes = 64;
  double b = 0;
  for (int i = 0; i < kNodes; ++i) {
    const double X = cos_phi * cos((i + 0.5) / kNodes * M_PI / 2);
    b += z_0 * (log((1 + X) / (1 - X)) - 2 * X) / (2 * kNodes);
  }
  return a * p.k_phi + b * p.k_r / p.L_x;
}

}  // namespace bristle
