#pragma once

#include "model/parameters.hpp"

#include <array>

namespace bristle {

// Constants of a friction law's modulation. Each law documents its own.
template <class P>
using FrictionConstants = std::array<P, 4>;

// Constants of one bristle under the slab, precomputed for the equations. P is the number type: double, or a
// SIMD vector with one bristle per lane. Dimensionless, angles in rad.
template <class P>
struct Bristle {
  FrictionLaw friction;
  AzimuthRate azimuth_rate;
  P k_r, k_theta, k_phi, c_theta, c_phi, theta_0, phi_0;
  FrictionConstants<P> friction_constants;
  P friction_factor;                 // Eqs. (14-16): F_f = friction_factor * modulation(V_R) * load(F_n)
  P pole_peak, pole_rate;            // Eq. (4): alpha/(2 lambda), 1/lambda
  P wall_peak, wall_rate;            // Eq. (3): beta/(2 lambda_z), 1/lambda_z
  P wall_root_peak, wall_root_rate;  // cube root of wall_peak, wall_rate/3
  P z_0;
};

// Pointers to all numbers of a Bristle, in a fixed order.
// The SIMD engine uses them to copy a bristle into a lane.
template <class B>
constexpr auto constants_of(B& b) {
  auto& friction = b.friction_constants;
  return std::array{&b.k_r,       &b.k_theta,         &b.k_phi,          &b.c_theta,   &b.c_phi,
                    &b.theta_0,   &b.phi_0,           &friction[0],      &friction[1], &friction[2],
                    &friction[3], &b.friction_factor, &b.pole_peak,      &b.pole_rate, &b.wall_peak,
                    &b.wall_rate, &b.wall_root_peak,  &b.wall_root_rate, &b.z_0};
}
constexpr std::size_t kConstants =
    std::tuple_size_v<decltype(constants_of(std::declval<Bristle<double>&>()))>;
static_assert(sizeof(Bristle<double>) ==
                  sizeof(FrictionLaw) + sizeof(AzimuthRate) + kConstants * sizeof(double),
              "constants_of() must list every number of Bristle");

// Evaluates Eqs. (11, 12) and the derived constants of Eqs. (3, 4, 7, 14-16) for the gap z_0 (dimensionless)
// and the undeformed azimuth theta_0 (rad).
Bristle<double> make_bristle(const Parameters& p, double z_0, double theta_0);

}  // namespace bristle
