#include "bristle/dynamics/rules.hpp"

namespace bristle {

using namespace component;

bool apply_pole_rule(const Parameters& p, OdeState& y) {
  const double square = singular_square(p.bending, y), inward = singular_product(p.bending, y);
  if (inward >= 0) return false;
  if (has_pole(p.bending) && p.pole_rule == PoleRule::cross) {
    y[THETA] += y[X] * y[VY] - y[Y] * y[VX] >= 0 ? M_PI : -M_PI;
    y[X] = -y[X];
    y[Y] = -y[Y];
    return true;
  }
  for (int i = 0; i < (has_pole(p.bending) ? 2 : 3); ++i) y[VX + i] -= 2 * inward / square * y[X + i];
  return true;
}

}  // namespace bristle
