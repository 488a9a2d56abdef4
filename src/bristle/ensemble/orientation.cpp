#include "bristle/ensemble/orientation.hpp"

#include "bristle/model/elementary.hpp"
#include "bristle/random.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bristle {

namespace {

// Returns the density of the von Mises distribution relative to its peak.
double relative_density(double kappa, double from_mean) {
  const double half = sin(from_mean / 2);
  return exp(-2 * kappa * half * half);
}

// Returns the integral of relative_density(), by the trapezoidal rule over the circle or over ten standard
// deviations on both sides of the peak. For a periodic or vanishing integrand the rule converges faster than
// any power; with this number of nodes its error is below rounding.
double integral(double kappa) {
  constexpr int nodes = 64;
  const double half_width = kappa > 0 ? std::min(M_PI, 10 / std::sqrt(kappa)) : M_PI;
  double sum = 0;
  for (int i = 0; i < nodes; ++i) sum += relative_density(kappa, half_width * (2.0 * i / nodes - 1));
  return sum * 2 * half_width / nodes;
}

}  // namespace

Density::Density(const Orientation& o)
    : mean_(o.mean),
      concentration_(o.distribution == Distribution::uniform ? 0 : o.concentration),
      peak_(1 / (concentration_ > 0 ? integral(concentration_) : 2 * M_PI)) {}

double Density::operator()(double theta_0) const {
  return concentration_ > 0 ? peak_ * relative_density(concentration_, theta_0 - mean_) : peak_;
}

double standard_deviation(const Orientation& o) {
  if (o.distribution == Distribution::uniform) return std::numeric_limits<double>::infinity();
  return 1 / std::sqrt(o.concentration);
}

bool mirror_symmetric(const Orientation& o) {
  if (o.sampling != Sampling::quadrature) return false;
  return o.distribution == Distribution::uniform || std::abs(sin(o.mean)) < 1e-12;
}

namespace {

// Returns a number that is uniform in [0, 1), keyed by seed, index of the bristle and number of the draw.
double uniform(std::uint64_t seed, std::uint64_t index, std::uint64_t draw) {
  const std::uint64_t bits = split_mix(split_mix(split_mix(seed) + index) + draw);
  return double(bits >> 11) * 0x1p-53;
}

// Draws from the von Mises distribution by rejection from a wrapped Cauchy distribution (D. J. Best and N. I.
// Fisher, Applied Statistics 28 (1979) 152).
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
