#pragma once

#include "bristle/model/parameters.hpp"
#include "bristle/model/si_scales.hpp"

// Converts a brush in SI units, or a friction coefficient, to the dimensionless parameters of the model.
namespace bristle {

// Returns one unit of each dimensionless quantity of bristles with the tip mass m in kg and the length r0 in
// m under a slab with the velocity V0 in m/s. All are positive.
SiScales si_scales(double m, double r0, double V0);

// Returns k_phi in N m/rad of a round shaft that bends like a cantilever: 3 pi E R^4/(4 r0), section 3 of the
// paper. E: Young's modulus in Pa; R: radius in m; r0: length in m
double cantilever_stiffness(double E, double R, double r0);

// Returns the mass in kg that, at the tip of a massless shaft, vibrates in bending as fast as the shaft with
// its own mass in its first mode: 3/beta^4 = 0.2427 of rho pi R^2 r0, where beta = 1.8751 is the first root
// of cos(beta) cosh(beta) = -1 (S. S. Rao, Mechanical Vibrations, on the bending of beams). rho: density in
// kg/m^3; R: radius in m; r0: length in m
double modal_mass(double rho, double R, double r0);

// Returns the contact modulus E* in Pa of a tip with Young's modulus E in Pa and Poisson's ratio nu against a
// rigid slab: E/(1 - nu^2), Hertz.
double contact_modulus(double E, double nu);

// Sets the strength of the friction law (mu_c, or tau_f of the law by contact area) such that rigid bristles
// have the friction coefficient mu under the load R_n, Eq. (22). R_n: dimensionless, positive
void set_nominal_friction(Parameters& p, double mu, double R_n);

}  // namespace bristle
