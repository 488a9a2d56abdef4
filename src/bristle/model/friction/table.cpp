#include "bristle/model/friction/table.hpp"

#include "bristle/model/error.hpp"
#include "bristle/model/friction/laws.hpp"
#include "bristle/message.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace bristle {
namespace {

// Size of q above which the relative error of q is bounded instead of the absolute one, by kModulationError
// divided by this size.
constexpr double kLarge = 100;

// Zeros of the Chebyshev polynomial of degree 4, in an interval from 0 to 1.
constexpr std::array<double, 4> kNodes = {(1 - 0.92387953251128674) / 2, (1 - 0.38268343236508977) / 2,
                                          (1 + 0.38268343236508977) / 2, (1 + 0.92387953251128674) / 2};

// Returns the coefficients of the cubic through the values at kNodes, by Newton's divided differences.
std::array<double, 4> cubic_through(std::array<double, 4> value) {
  for (int order = 1; order < 4; ++order)
    for (int i = 3; i >= order; --i) value[i] = (value[i] - value[i - 1]) / (kNodes[i] - kNodes[i - order]);
  std::array<double, 4> c{value[3]};
  for (int i = 2; i >= 0; --i) {
    for (int power = 3; power > 0; --power) c[power] = c[power - 1] - kNodes[i] * c[power];
    c[0] = value[i] - kNodes[i] * c[0];
  }
  return c;
}

}  // namespace

ModulationTable::ModulationTable(FrictionLaw law, const FrictionConstants<double>& constants)
    : law_(law), constants_(constants) {
  if (const ModulationTable* own = constants.table) {
    V_scale_ = own->V_scale_;
    intervals_ = own->intervals_;
    coefficients_ = own->coefficients_;
    return;
  }
  int intervals = kFewestIntervals;
  while (!build(intervals)) {
    intervals *= 2;
    if (intervals > kMostIntervals)
      throw ModelError(message("the modulation of the friction law ", word(law),
                               " changes too steeply with the sliding speed (A, C)"));
  }
}

ModulationTable::ModulationTable(double V_scale, std::vector<double> coefficients)
    : law_(FrictionLaw::custom),
      V_scale_(V_scale),
      intervals_(double(coefficients.size()) / 4 - 1),
      coefficients_(std::move(coefficients)) {}

ModulationTable::Entry ModulationTable::entry(double u) const {
  const double t = u / (1 + u), scaled = t * intervals_;
  const auto interval = std::ptrdiff_t(scaled <= intervals_ ? scaled : 0);  // 0: u is not finite
  return {t, scaled - double(interval), coefficients_.data() + 4 * interval};
}

double ModulationTable::at(double u) const {
  const auto [t, x, c] = entry(u);
  return t * (c[0] + x * (c[1] + x * (c[2] + x * c[3])));
}

double ModulationTable::slope(double u) const {
  const auto [t, x, c] = entry(u);
  const double q = c[0] + x * (c[1] + x * (c[2] + x * c[3]));
  const double dq = intervals_ * (c[1] + x * (2 * c[2] + x * 3 * c[3]));
  return (q + t * dq) / ((1 + u) * (1 + u));
}

// Returns q(t), for 0 < t < 1.
double ModulationTable::exact(double t) const {
  return with_law(law_, [&](auto law) { return law.modulation(t / (1 - t), constants_); }) / t;
}

// Builds the table with this number of intervals. Returns false if the error, measured between the nodes, is
// too large. A modulation that overflows gives a table that is not finite, and passages that are not finite.
bool ModulationTable::build(int intervals) {
  intervals_ = intervals;
  coefficients_.clear();
  double worst = 0, largest = 0;
  for (int i = 0; i < intervals; ++i) {
    const auto at = [&](double u) { return exact((i + u) / intervals); };
    std::array<double, 4> value;
    for (int k = 0; k < 4; ++k) value[k] = at(kNodes[k]);
    const std::array<double, 4> c = cubic_through(value);
    for (const double u : {1e-3, 0.2, 0.5, 0.8, 1 - 1e-3}) {
      const double polynomial = c[0] + u * (c[1] + u * (c[2] + u * c[3]));
      worst = std::max(worst, std::abs(polynomial - at(u)));
    }
    for (const double one : value) largest = std::max(largest, std::abs(one));
    coefficients_.insert(coefficients_.end(), c.begin(), c.end());
  }
  // t = 1, to which t may round, is the start of a further interval.
  const double* last = coefficients_.data() + std::ptrdiff_t(4) * (intervals - 1);
  const double end = last[0] + last[1] + last[2] + last[3];
  coefficients_.insert(coefficients_.end(), {end, 0, 0, 0});
  return !std::isfinite(largest) || worst < kModulationError / 2 * std::max(1.0, largest / kLarge);
}

}  // namespace bristle
