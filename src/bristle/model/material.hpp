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

// Returns the contact modulus E* in Pa of a tip with Young's modulus E in Pa and Poisson's ratio nu against a
// rigid slab: E/(1 - nu^2), Hertz.
double contact_modulus(double E, double nu);

// Sets the strength of the friction law (mu_c, or tau_f of the law by contact area) such that rigid bristles
// have the friction coefficient mu under the load R_n, Eq. (22). R_n: dimensionless, positive
void set_nominal_friction(Parameters& p, double mu, double R_n);

}  // namespace bristle
