#include "compare/comparison.hpp"

#include <cmath>
#include <limits>

namespace bristle::compare {

double in_tolerances(double a, double b, double tolerance) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!std::isfinite(a) || !std::isfinite(b)) return infinity;
  const double distance = std::abs(a - b);
  if (distance == 0) return 0;
  return tolerance == 0 ? infinity : distance / tolerance;
}

}  // namespace bristle::compare
