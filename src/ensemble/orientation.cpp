#include "ensemble/orientation.hpp"

#include "model/elementary.hpp"
#include "util/random.hpp"

#include <algorithm>
#include <cmath>

namespace bristle {

namespace {

// exp(-kappa) times the modified Bessel function I_0(kappa), by the trapezoidal
// rule for its integral. For a periodic integrand the rule converges faster
// than any power; with this number of nodes its error is below rounding.
double scaled_bessel(double kappa) {
  const int nodes = 32 + int(std::ceil(10 * std::sqrt(kappa)));
  double sum = 0;
  for (int i = 0; i < nodes; ++i) sum += exp(kappa * (cos(2 * M_PI * i / nodes) - 1));
  return sum / nodes;
}

}  // namespace

double density(const Orientation& o, double theta_0) {
  if (o.distribution == Distribution::uniform) return 1 / (2 * M_PI);
  // Numerator and denominator are scaled by exp(-kappa), so that large concentrations do not overflow.
  const double kappa = o.concentration;
  return exp(kappa * (cos(theta_0 - o.mean) - 1)) / (2 * M_PI * scaled_bessel(kappa));
}

bool mirror_symmetric(const Orientation& o) {
  if (o.sampling != Sampling::quadrature) return false;
  return o.distribution == Distribution::uniform || std::abs(sin(o.mean)) < 1e-12;
}

namespace {

// Uniform in [0, 1), keyed by seed, index of the bristle and number of the draw.
double uniform(std::uint64_t seed, std::uint64_t index, std::uint64_t draw) {
  const std::uint64_t bits = split_mix(split_mix(split_mix(seed) + index) + draw);
  return double(bits >> 11) * 0x1p-53;
}

// D. J. Best and N. I. Fisher, Applied Statistics 28 (1979)
// 152: rejection from a wrapped Cauchy distribution.
double von_mises(double kappa, std::uint64_t seed, std::uint64_t index) {
  const double tau = 1 + std::sqrt(1 + 4 * kappa * kappa);
  const double rho = (tau - std::sqrt(2 * tau)) / (2 * kappa);
  const double r = (1 + rho * rho) / (2 * rho);
  for (std::uint64_t draw = 0;; draw += 3) {
    const double z = cos(M_PI * uniform(seed, index, draw));
    const double f = (1 + r * z) / (r + z), c = kappa * (r - f);
    const double u = uniform(seed, index, draw + 1);
    if (c * (2 - c) < u && log(c / u) + 1 < c) continue;
    const double angle = acos(std::clamp(f, -1.0, 1.0));
    return uniform(seed, index, draw + 2) < 0.5 ? -angle : angle;
  }
}

}  // namespace

double random_azimuth(const Orientation& o, std::uint64_t index) {
  // Below this concentration the density is uniform to 1e-4, and
  // the constants of the rejection method suffer from cancellation.
  constexpr double flat = 1e-4;
  if (o.distribution == Distribution::uniform || o.concentration < flat)
    return M_PI * (2 * uniform(o.seed, index, 0) - 1);
  return std::remainder(o.mean + von_mises(o.concentration, o.seed, index), 2 * M_PI);
}

}  // namespace bristle
