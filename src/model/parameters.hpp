#pragma once

namespace bristle {

enum class FrictionLaw : int;  // model/friction/laws.hpp

// theta' from the tip's velocity: kinematically exact, or by Eq. (17) as printed.
enum class AzimuthRate {
  kinematic,
  as_printed
};

// State of the bristle at the slab's leading edge, at rest in the vertical plane theta = theta_0:
// static_equilibrium: frictionless equilibrium of springs, pole repulsion and wall force;
// at_slab: tip at z = z_0, at the polar angle of least energy of springs and pole repulsion;
// unstretched: r = 1, tip 5 lambda_z below z_0;
// upright: tip at z = z_0, at the undeformed polar angle phi_0.
enum class InitialState {
  static_equilibrium,
  at_slab,
  unstretched,
  upright
};

// Rule for a tip that reaches s = s_min: reflect reverses its radial
// in-plane velocity, cross moves it to the opposite side of the pole.
enum class PoleRule {
  reflect,
  cross
};

// The parameters of bristle, friction and slab, dimensionless (length r0, time r0/V0, force m V0^2/r0).
// Values without a source in the paper are assumptions, listed in docs/model.md.
struct Parameters {
  FrictionLaw friction{};             // nss
  double k_r = 10;                    // radial stiffness
  double k_theta = 1;                 // azimuthal (torsional) stiffness
  double k_phi = 1.9;                 // polar (bending) stiffness
  double phi_0 = 1.3962634015954636;  // undeformed polar angle from the x-y plane, rad (80 deg)
  double zeta_theta = 0.1;            // damping ratios, Eq. (11)
  double zeta_phi = 0.1;
  double mu_c = 1;          // Coulomb: kinetic friction coefficient, Eq. (14)
  double tau_f = 3e4;       // NSS: shear stress, Eq. (15)
  double R_c = 1.0 / 17;    // tip radius, Eq. (16)
  double E_star = 5.849e4;  // contact modulus, Eq. (16)
  double A = 1.2;           // chi's maximum, Eq. (7)
  double C = -5.592;        // chi's shape, Eq. (7)
  double V_s = 0.01;        // threshold speed between static and kinetic friction, Eq. (7)
  double lambda = 1e-3;     // range and strength of the pole repulsion, Eq. (4)
  double alpha = 1;
  double lambda_z = 1e-3;  // range and strength of the slab's wall, Eq. (3)
  double beta = 1;
  AzimuthRate azimuth_rate = AzimuthRate::kinematic;
  InitialState initial_state = InitialState::static_equilibrium;
  PoleRule pole_rule = PoleRule::reflect;
  double s_min = 1e-4;   // distance from the pole at which the pole rule acts
  double L_x = 5;        // slab length
  double L_y = 5;        // slab width (lattice sampling only)
  double spacing = 0.2;  // lattice spacing Delta (lattice sampling only)
};

}  // namespace bristle
