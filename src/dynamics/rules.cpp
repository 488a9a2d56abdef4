#include "dynamics/rules.hpp"

#include <boost/math/tools/roots.hpp>
#include <limits>

namespace bristle {

bool apply_pole_rule(PoleRule rule, OdeState& y) {
  const double s2 = y[X] * y[X] + y[Y] * y[Y], inward = radial_product(y);
  if (inward >= 0) return false;
  if (rule == PoleRule::reflect) {
    y[VX] -= 2 * inward / s2 * y[X];
    y[VY] -= 2 * inward / s2 * y[Y];
  } else {
    y[THETA] += y[X] * y[VY] - y[Y] * y[VX] >= 0 ? M_PI : -M_PI;
    y[X] = -y[X];
    y[Y] = -y[Y];
  }
  return true;
}

double first_root(const std::function<double(double)>& g, double a, double b, double tolerance) {
  std::uintmax_t iterations = 100;
  const double g_a = g(a), g_b = g(b);
  if (g_a >= 0) return a;
  if (g_b <= 0) return b;
  const auto close = [tolerance](double l, double r) { return r - l <= tolerance; };
  const auto bracket = boost::math::tools::toms748_solve(g, a, b, g_a, g_b, close, iterations);
  return bracket.second;
}

double pole_contact(const std::function<OdeState(double)>& state_at, double s_min, double a, double b,
                    double tolerance) {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (radial_product(state_at(a)) >= 0) return never;
  double nearest = b;
  if (radial_product(state_at(b)) > 0)
    nearest = first_root([&](double t) { return radial_product(state_at(t)); }, a, b, tolerance);
  const auto inside = [&](double t) { return s_min - in_plane_distance(state_at(t)); };
  if (inside(nearest) < 0) return never;
  return first_root(inside, a, nearest, tolerance);
}

}  // namespace bristle
