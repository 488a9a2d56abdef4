#include "model/bristle.hpp"

#include "model/elementary.hpp"
#include "model/friction/laws.hpp"

#include <cmath>

namespace bristle {

Bristle<double> make_bristle(const Parameters& p, double z_0, double theta_0) {
  Bristle<double> b{};
  b.friction = p.friction;
  b.azimuth_rate = p.azimuth_rate;
  b.k_r = p.k_r;
  b.k_theta = p.k_theta;
  b.k_phi = p.k_phi;
  b.c_theta = 2 * p.zeta_theta * std::sqrt(p.k_theta) * cos(p.phi_0);
  b.c_phi = 2 * p.zeta_phi * std::sqrt(p.k_phi);
  b.theta_0 = theta_0;
  b.phi_0 = p.phi_0;
  with_law(p.friction, [&](auto law) {
    b.friction_constants = law.constants(p);
    b.friction_factor = law.factor(p);
  });
  b.pole_peak = p.alpha / (2 * p.lambda);
  b.pole_rate = 1 / p.lambda;
  b.wall_peak = p.beta / (2 * p.lambda_z);
  b.wall_rate = 1 / p.lambda_z;
  b.wall_root_peak = cbrt(b.wall_peak);
  b.wall_root_rate = b.wall_rate / 3;
  b.z_0 = z_0;
  return b;
}

}  // namespace bristle
