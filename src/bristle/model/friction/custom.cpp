#include "bristle/model/friction/custom.hpp"

#include <math.h>  // Boost 1.74 calls isnan without std::

#include <boost/math/interpolators/pchip.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace bristle {
namespace {

// Largest error of mu that the table may have, as a share of the largest mu.
constexpr double kTableError = 1e-4;

// mu and its derivative by V_R. At the last speed, beyond which mu is constant, slope is the derivative on
// the side of lower speeds.
struct Value {
  double mu, slope;
};

// Returns the slope dmu/dV_R of a monotone cubic at one end of its values: the slope of the parabola through
// three values, limited so that the curve stays monotone (Fritsch and Butland 1984, as in SciPy and MATLAB).
// near and far are the widths of the two intervals from that end, rise and next the slopes of their secants.
double end_slope(double near, double far, double rise, double next) {
  const double slope = ((2 * near + far) * rise - near * next) / (near + far);
  if (slope * rise <= 0) return 0;
  return rise * next < 0 && std::abs(slope) > std::abs(3 * rise) ? 3 * rise : slope;
}

class Interpolant {
 public:
  explicit Interpolant(const FrictionValues& law) : law_(law) {
    if (law.linear) return;
    using Pchip = boost::math::interpolators::pchip<std::vector<double>>;
    const std::vector<double>&x = law.V_R, &y = law.mu;
    const auto width = [&x](std::size_t i) { return x[i + 1] - x[i]; };
    const auto secant = [&](std::size_t i) { return (y[i + 1] - y[i]) / width(i); };
    const std::size_t last = x.size() - 2;
    const double first = end_slope(width(0), width(1), secant(0), secant(1)),
                 end = end_slope(width(last), width(last - 1), secant(last), secant(last - 1));
    auto curve = std::make_shared<Pchip>(std::vector(x), std::vector(y), first, end);
    at_ = [curve](double V_R) { return Value{(*curve)(V_R), curve->prime(V_R)}; };
  }

  Value operator()(double V_R) const {
    const std::vector<double>&x = law_.V_R, &y = law_.mu;
    if (V_R > x.back()) return {y.back(), 0};
    if (at_) return at_(V_R);
    const auto i = std::size_t(std::upper_bound(x.begin(), x.end() - 1, V_R) - x.begin());
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

// A friction law over t = V_R/(V_R + V_scale). V_scale is such that the last speed, beyond which mu is
// constant, is at t_end = 1 - 2^-k: mu may have a corner there, which then lies between two intervals of
// every table.
struct Law {
  Interpolant mu;
  double V_end, V_scale, t_end;
};

// Returns the law of these values. Its V_scale is near the geometric mean of the first speed and the last.
Law law_of(const FrictionValues& values) {
  const double V_end = values.V_R.back();
  const double wanted = 1 / (1 + std::sqrt(V_end / values.V_R[1]));
  double rest = 0.5;  // 2^-k
  while (rest > M_SQRT2 * wanted) rest /= 2;
  return {Interpolant(values), V_end, V_end * rest / (1 - rest), 1 - rest};
}

Knot knot(const Law& law, double t) {
  if (t == 1) return {law.mu(INFINITY).mu, -law.mu(INFINITY).mu};
  const double rest = 1 - t;
  const auto [value, slope] = law.mu(t == law.t_end ? law.V_end : law.V_scale * t / rest);
  return {value / t, (slope * law.V_scale / (rest * rest) - value / t) / t};
}

// Returns the coefficients of the cubic in the position within an interval, from 0 to 1, with the values and
// slopes a and b at the ends of the interval.
std::array<double, 4> cubic_between(const Knot& a, const Knot& b, double width) {
  const double rise = b.q - a.q, from = width * a.slope, to = width * b.slope;
  return {a.q, from, 3 * rise - 2 * from - to, from + to - 2 * rise};
}

// Returns the knot at t = 0 of the first interval. q is a limit there, and its slope is chosen so that the
// cubic has the right value in the middle of the interval. `next` is the knot at the end of the interval.
Knot first_knot(const Law& law, double width, const Knot& next) {
  const double q = law.mu(0).slope * law.V_scale, middle = knot(law, width / 2).q;
  return {q, 8 * (middle - (q + next.q) / 2) / width + next.slope};
}

// Sets the coefficients for this number of intervals and returns the largest error of mu between the ends of
// the intervals; infinity if a coefficient is not finite.
double fill(std::vector<double>& coefficients, const Law& law, int intervals) {
  coefficients.clear();
  const double width = 1.0 / intervals;
  double worst = 0;
  Knot from = first_knot(law, width, knot(law, width));
  for (int i = 0; i < intervals; ++i) {
    const Knot to = knot(law, double(i + 1) / intervals);
    const std::array<double, 4> c = cubic_between(from, to, width);
    for (const double u : {0.25, 0.5, 0.75}) {
      const double t = (i + u) / intervals, cubic = t * (c[0] + u * (c[1] + u * (c[2] + u * c[3])));
      worst = std::max(worst, std::abs(cubic - t * knot(law, t).q));
    }
    coefficients.insert(coefficients.end(), c.begin(), c.end());
    from = double(i + 1) / intervals == law.t_end ? Knot{to.q, -to.q / law.t_end} : to;
  }
  coefficients.insert(coefficients.end(), {from.q, 0, 0, 0});
  const bool finite = std::ranges::all_of(coefficients, [](double one) { return std::isfinite(one); });
  return finite ? worst : INFINITY;
}

}  // namespace

std::shared_ptr<const ModulationTable> modulation_table(const FrictionValues& values) {
  const Law law = law_of(values);
  const double allowed = kTableError * std::ranges::max(values.mu);
  std::vector<double> coefficients;
  for (int intervals = kFewestIntervals; intervals <= kMostIntervals; intervals *= 2) {
    if (intervals * (1 - law.t_end) < 1) continue;  // the last speed would be within an interval
    if (fill(coefficients, law, intervals) > allowed) continue;
    auto table = std::make_shared<ModulationTable>(law.V_scale, coefficients);
    double worst = 0;  // largest error at the corners
    for (std::size_t i = 0; i < values.V_R.size(); ++i)
      worst = std::max(worst, std::abs(table->at(values.V_R[i] / law.V_scale) - values.mu[i]));
    if (worst <= allowed) return table;
  }
  throw std::invalid_argument(
      "changes too steeply with V_R; take a narrower range of speeds, and in a table fewer values "
      "where speeds are close to each other");
}

}  // namespace bristle
