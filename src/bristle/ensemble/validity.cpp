#include "bristle/ensemble/validity.hpp"

#include <cmath>

namespace bristle {

Exceeds exceeds(const ValidityRow& row, const PointResult& point) {
  const double excess = row.excess(point);
  if (std::isnan(excess)) return Exceeds::unknown;
  return excess > 0 ? Exceeds::yes : Exceeds::no;
}

}  // namespace bristle
