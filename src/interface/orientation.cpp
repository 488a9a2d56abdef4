#include "interface/orientation.hpp"

#include <boost/math/special_functions/bessel.hpp>
#include <cmath>

namespace bristle {

double density(const Orientation& o, double theta_0) {
  if (o.distribution == Distribution::uniform) return 1 / (2 * M_PI);
  // exp(-kappa) on both sides keeps large concentrations finite.
  const double kappa = o.concentration;
  const double normal = 2 * M_PI * boost::math::cyl_bessel_i(0, kappa) * std::exp(-kappa);
  return std::exp(kappa * (std::cos(theta_0 - o.mean) - 1)) / normal;
}

bool mirror_symmetric(const Orientation& o) {
  if (o.sampling == Sampling::list) return false;
  return o.distribution == Distribution::uniform || std::abs(std::sin(o.mean)) < 1e-12;
}

}  // namespace bristle
