#pragma once

#include "bristle/model/contact.hpp"
#include "bristle/model/friction/laws.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace bristle {

// Constants of one bristle under the slab, precomputed for the equations. P is the number type: double, or a
// SIMD vector with one bristle per lane. Dimensionless, angles in rad.
template <class P>
struct Bristle {
  FrictionLaw friction;
  Bending bending;
  Contact contact;
  P k_r, k_theta, k_phi, c_theta, c_phi, theta_0, phi_0;
  P cos_theta_0, sin_theta_0, cos_phi_0, sin_phi_0;
  FrictionConstants<P> friction_constants;
  P friction_factor;       // Eqs. (14-16): F_f = friction_factor * modulation(V_R/V_scale) * load(F_n)
  P pole_peak, pole_rate;  // Eq. (4): alpha/(2 lambda), 1/lambda
  P wall_peak, wall_rate;  // Eq. (3): beta/(2 lambda_z), 1/lambda_z; 0 with the Hertz contact
  P wall_root_peak, wall_root_rate;       // cube root of wall_peak, wall_rate/3
  P hertz_stiffness, hertz_stiffness_23;  // hertz_stiffness(), and its power 2/3; 0 with the wall
  P off_slab;                             // distance below the slab beyond which a tip is off it
  P z_0;
  P V_s, V_scale;  // below V_s a tip sticks; V_scale is the speed scale of the friction law
};

// Returns pointers to all numbers of a Bristle, in a fixed order. The SIMD engine uses them to copy a bristle
// into a lane.
template <class B>
constexpr auto constants_of(B& b) {
  auto& friction = b.friction_constants;
  return std::array{&b.k_r,
                    &b.k_theta,
                    &b.k_phi,
                    &b.c_theta,
                    &b.c_phi,
                    &b.theta_0,
                    &b.phi_0,
                    &b.cos_theta_0,
                    &b.sin_theta_0,
                    &b.cos_phi_0,
                    &b.sin_phi_0,
                    &friction[0],
                    &friction[1],
                    &friction[2],
                    &b.friction_factor,
                    &b.pole_peak,
                    &b.pole_rate,
                    &b.wall_peak,
                    &b.wall_rate,
                    &b.wall_root_peak,
                    &b.wall_root_rate,
                    &b.hertz_stiffness,
                    &b.hertz_stiffness_23,
                    &b.off_slab,
                    &b.z_0,
                    &b.V_s,
                    &b.V_scale};
}
constexpr std::size_t kConstants =
    std::tuple_size_v<decltype(constants_of(std::declval<Bristle<double>&>()))>;
static_assert(sizeof(Bristle<double>) == sizeof(FrictionLaw) + sizeof(Bending) + sizeof(Contact) +
                                             sizeof(int) + kConstants * sizeof(double) +
                                             sizeof(double),  // of a pointer, with what fills it up
              "constants_of() must list every number of Bristle");

// Distance below the slab, in multiples of contact_range(), beyond which a tip is off a wall: F_n is then
// below 0.03 for the paper's beta.
constexpr double kOffSlabRanges = 10;
// Distance below the slab beyond which any tip is off it: a tip that begins at the slab is there up to
// rounding.
constexpr double kOffSlabRounding = 1e-12;

// Returns the constants of a bristle for the gap z_0 (dimensionless) and the undeformed azimuth theta_0
// (rad). Evaluates Eqs. (11, 12), or for a rod the damping of a unit mass at r = 1, and the derived constants
// of Eqs. (3, 4, 7, 14-16), or of the Hertz contact in place of Eq. (3).
inline Bristle<double> make_bristle(const Parameters& p, double z_0, double theta_0) {
  Bristle<double> b{};
  b.friction = p.friction;
  b.bending = p.bending;
  b.contact = p.contact;
  b.k_r = p.k_r;
  b.k_theta = azimuthal_stiffness(p);
  b.k_phi = p.k_phi;
  b.c_theta = 2 * p.zeta_theta * std::sqrt(b.k_theta) * (has_pole(p.bending) ? cos(p.phi_0) : 1);
  b.c_phi = 2 * p.zeta_phi * std::sqrt(p.k_phi);
  b.theta_0 = theta_0;
  b.phi_0 = p.phi_0;
  b.cos_theta_0 = cos(theta_0);
  b.sin_theta_0 = sin(theta_0);
  b.cos_phi_0 = cos(p.phi_0);
  b.sin_phi_0 = sin(p.phi_0);
  with_law(p.friction, [&](auto law) {
    b.friction_constants = law.constants(p);
    b.friction_factor = law.factor(p);
    b.V_scale = law.V_scale(p);
  });
  b.pole_peak = has_pole(p.bending) ? p.alpha / (2 * p.lambda) : 0;
  b.pole_rate = has_pole(p.bending) ? 1 / p.lambda : 0;
  if (p.contact == Contact::wall) {
    b.wall_peak = p.beta / (2 * p.lambda_z);
    b.wall_rate = 1 / p.lambda_z;
    b.wall_root_peak = cbrt(b.wall_peak);
    b.wall_root_rate = b.wall_rate / 3;
  } else {
    b.hertz_stiffness = hertz_stiffness(p.R_c, p.E_star);
    const double root = cbrt(b.hertz_stiffness);
    b.hertz_stiffness_23 = root * root;
  }
  b.off_slab = std::max(kOffSlabRanges * contact_range(p), kOffSlabRounding);
  b.z_0 = z_0;
  b.V_s = p.V_s;
  return b;
}

// (x, y, z), in units of r0 or V0.
template <class T>
using Vector3 = std::array<T, 3>;

// Tip position and velocity, azimuth theta (unwrapped) and polar angle phi (from the x-y plane), rad. For a
// rod, theta and phi keep their initial values.
template <class T>
struct State {
  Vector3<T> r, v;
  T theta, phi;
};

}  // namespace bristle
