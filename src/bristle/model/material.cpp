#include "bristle/model/material.hpp"

#include "bristle/model/friction/laws.hpp"

#include <cmath>

namespace bristle {

SiScales si_scales(double m, double r0, double V0) {
  const double energy = m * V0 * V0, force = energy / r0;
  return {r0, V0, energy, force, force / r0, force / (r0 * r0)};
}

double cantilever_stiffness(double E, double R, double r0) {
  return 3 * M_PI * E * (R * R) * (R * R) / (4 * r0);
}

double modal_mass(double rho, double R, double r0) {
  const double square = 1.8751040687119612 * 1.8751040687119612;
  return 3 / (square * square) * rho * M_PI * R * R * r0;
}

double contact_modulus(double E, double nu) { return E / (1 - nu * nu); }

void set_nominal_friction(Parameters& p, double mu, double R_n) {
  with_law(p.friction, [&](auto law) {
    p.*law.strength = 1;
    p.*law.strength = mu * R_n / law.rigid(p, R_n);
  });
}

}  // namespace bristle
