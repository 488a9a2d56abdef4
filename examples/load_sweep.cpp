// Friction over load of the brush of a ski slope, with the contact of the paper's wall and with that of
// Hertz, and with a friction law of one's own: mu falls from 0.4 to 0.25 as the speed rises.
#include <bristle/ensemble/point.hpp>
#include <bristle/model/friction/custom.hpp>
#include <bristle/model/material.hpp>
#include <bristle/simd/runner.hpp>

#include <cstdio>

namespace {

// Tip mass in kg; length of a bristle and radii of its shaft and its tip in m.
constexpr double kMass = 1e-4, kLength = 0.017, kRadius = 0.00108, kTipRadius = 0.001;
constexpr double kYoung = 1e8, kPoisson = 0.4;  // Pa, dimensionless
constexpr double kSpeed = 10;                   // of the slab, m/s

// The friction law, as a tribometer measures it: mu at sliding speeds in units of kSpeed.
const bristle::FrictionValues kLaw{.V_R = {0, 0.001, 0.003, 0.1, 0.3, 1, 3},
                                   .mu = {0, 0.3, 0.4, 0.36, 0.31, 0.26, 0.25}};

bristle::Parameters ski_slope(const bristle::SiScales& si) {
  bristle::Parameters p;
  p.bending = bristle::Bending::rod;
  p.k_phi = bristle::cantilever_stiffness(kYoung, kRadius, kLength) / si.energy;
  p.k_r = 10 * p.k_phi;
  p.R = kRadius / si.length;
  p.R_c = kTipRadius / si.length;
  p.E_star = bristle::contact_modulus(kYoung, kPoisson) / si.stress;
  p.friction = bristle::FrictionLaw::custom;
  p.mu_c = 1;
  return p;
}

}  // namespace

int main() {
  const bristle::SiScales si = bristle::si_scales(kMass, kLength, kSpeed);
  const auto law = bristle::modulation_table(kLaw);
  bristle::Setup setup;
  setup.parameters = ski_slope(si);
  setup.parameters.custom_friction.table = law.get();
  setup.orientation.rtol = 0.01;
  setup.integrator = {.rtol = 1e-4, .atol = 2e-4};
  const auto run = bristle::make_runner(bristle::Engine::fast);
  std::printf("R_n in N   contact   friction in N\n");
  for (const double newtons : {0.4, 0.8, 1.2})
    for (const auto contact : {bristle::Contact::wall, bristle::Contact::hertz}) {
      setup.parameters.contact = contact;
      const auto point = bristle::solve_point(setup, {.R_n = newtons / si.force}, run);
      std::printf("%8.1f   %-7s   %.4g +- %.1g (%s)\n", newtons, bristle::word(contact),
                  point.value[bristle::R_X] * si.force, point.error[bristle::R_X] * si.force,
                  bristle::word(point.status));
    }
}
