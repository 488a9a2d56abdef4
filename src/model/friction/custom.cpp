#include "model/friction/custom.hpp"

#include <math.h>  // Boost 1.74 calls isnan without std::

#include <boost/math/interpolators/pchip.hpp>
#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace bristle {
namespace {

constexpr double kSamplingError = 1e-5, kTableError = 1e-4;  // as a share of the largest mu

// mu and its derivative by V_R.
struct Value {
  double mu, slope;
};

class Interpolant {
 public:
  explicit Interpolant(const FrictionValues& law) : law_(law) {
    if (law.linear) return;
    using Pchip = boost::math::interpolators::pchip<std::vector<double>>;
    auto curve = std::make_shared<Pchip>(std::vector(law.V_R), std::vector(law.mu));
    at_ = [curve](double V_R) { return Value{(*curve)(V_R), curve->prime(V_R)}; };
  }

  Value operator()(double V_R) const {
    const std::vector<double>&x = law_.V_R, &y = law_.mu;
    if (V_R >= x.back()) return {y.back(), 0};
    if (at_) return at_(V_R);
    const auto i = std::size_t(std::ranges::upper_bound(x, V_R) - x.begin());
    const double slope = (y[i] - y[i - 1]) / (x[i] - x[i - 1]);
    return {y[i - 1] + slope * (V_R - x[i - 1]), slope};
  }

 private:
  const FrictionValues& law_;
  std::function<Value(double)> at_;
};

// q = mu/t and its derivative by t, for 0 < t <= 1 (table.hpp).
struct Knot {
  double q, slope;
};

Knot knot(const Interpolant& mu, double V_scale, double t) {
  if (t == 1) return {mu(INFINITY).mu, -mu(INFINITY).mu};
  const double rest = 1 - t;
  const auto [value, slope] = mu(V_scale * t / rest);
  return {value / t, (slope * V_scale / (rest * rest) - value / t) / t};
}

// The cubic with these values and slopes at both ends of the interval.
std::array<double, 4> cubic_between(const Knot& a, const Knot& b, double width) {
  const double rise = b.q - a.q, from = width * a.slope, to = width * b.slope;
  return {a.q, from, 3 * rise - 2 * from - to, from + to - 2 * rise};
}

// As cubic_between(), for the first interval: q at t = 0 is a limit, and its slope there is chosen so that
// the cubic has the right value in the middle.
Knot first_knot(const Interpolant& mu, double V_scale, double width, const Knot& next) {
  const double q = mu(0).slope * V_scale, middle = knot(mu, V_scale, width / 2).q;
  return {q, 8 * (middle - (q + next.q) / 2) / width + next.slope};
}

// The coefficients for this number of intervals, and the largest error of mu between their ends.
double fill(std::vector<double>& coefficients, const Interpolant& mu, double V_scale, int intervals) {
  coefficients.clear();
  const double width = 1.0 / intervals;
  double worst = 0;
  Knot from = first_knot(mu, V_scale, width, knot(mu, V_scale, width));
  for (int i = 0; i < intervals; ++i) {
    const Knot to = knot(mu, V_scale, double(i + 1) / intervals);
    const std::array<double, 4> c = cubic_between(from, to, width);
    for (const double u : {0.25, 0.5, 0.75}) {
      const double t = (i + u) / intervals, cubic = t * (c[0] + u * (c[1] + u * (c[2] + u * c[3])));
      worst = std::max(worst, std::abs(cubic - t * knot(mu, V_scale, t).q));
    }
    coefficients.insert(coefficients.end(), c.begin(), c.end());
    from = to;
  }
  coefficients.insert(coefficients.end(), {from.q, 0, 0, 0});
  const bool finite = std::ranges::all_of(coefficients, [](double one) { return std::isfinite(one); });
  return finite ? worst : INFINITY;
}

}  // namespace

FrictionValues sampled(const std::function<double(double)>& mu, double V_end) {
  constexpr double V_scale = 0.01;  // most values are near it, the default of V_s
  const double t_end = V_end / (V_end + V_scale);
  const auto checked = [&](double V_R) {
    const double value = mu(V_R);
    if (V_R == 0 && value != 0)
      throw std::invalid_argument(fmt::format("is {} at V_R = 0; a bristle at rest on the slab has no friction, so mu must "
                                              "rise from 0, as with a factor tanh(V_R/0.001)", value));
    if (V_R > 0 && !(value > 0 && std::isfinite(value)))
      throw std::invalid_argument(fmt::format("is {} at V_R = {:.6g}; mu must be positive and finite up to V_R = {:g}",
                                              value, V_R, V_end));
    return value;
  };
  for (int intervals = kFewestIntervals; intervals <= kMostIntervals; intervals *= 2) {
    FrictionValues law;
    for (int i = 0; i <= intervals; ++i) {
      const double t = t_end * i / intervals;
      law.V_R.push_back(i < intervals ? V_scale * t / (1 - t) : V_end);
      law.mu.push_back(checked(law.V_R.back()));
    }
    const Interpolant between(law);
    double worst = 0;
    for (std::size_t i = 0; i + 1 < law.V_R.size(); ++i) {
      const double middle = (law.V_R[i] + law.V_R[i + 1]) / 2;
      worst = std::max(worst, std::abs(between(middle).mu - checked(middle)));
    }
    if (worst <= kSamplingError * std::ranges::max(law.mu)) return law;
  }
  throw std::invalid_argument(fmt::format("changes too steeply with V_R: {} values do not describe it", kMostIntervals));
}

std::shared_ptr<const ModulationTable> modulation_table(const FrictionValues& law) {
  const Interpolant mu(law);
  const double V_scale = std::sqrt(law.V_R[1] * law.V_R.back());
  const double allowed = kTableError * std::ranges::max(law.mu);
  std::vector<double> coefficients;
  for (int intervals = kFewestIntervals; intervals <= kMostIntervals; intervals *= 2) {
    if (fill(coefficients, mu, V_scale, intervals) > allowed) continue;
    auto table = std::make_shared<ModulationTable>(V_scale, coefficients);
    double worst = 0;  // at the corners
    for (std::size_t i = 0; i < law.V_R.size(); ++i)
      worst = std::max(worst, std::abs(table->at(law.V_R[i] / V_scale) - law.mu[i]));
    if (worst <= allowed) return table;
  }
  throw std::invalid_argument("changes too steeply with V_R; take fewer values where speeds are close to each other, or "
                              "a narrower range of speeds");
}

}  // namespace bristle
