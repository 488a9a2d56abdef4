#include "dynamics/rules.hpp"

#include <boost/math/tools/roots.hpp>
#include <limits>

namespace bristle {

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

double first_root(const std::function<double(double)>& g, double a, double b, double tolerance) {
  std::uintmax_t iterations = 100;
  const double g_a = g(a), g_b = g(b);
  if (g_a >= 0) return a;
  if (g_b <= 0) return b;
  const auto close = [tolerance](double l, double r) { return r - l <= tolerance; };
  const auto bracket = boost::math::tools::toms748_solve(g, a, b, g_a, g_b, close, iterations);
  return bracket.second;
}

double pole_contact(const std::function<OdeState(double)>& state_at, const Parameters& p, double a, double b,
                    double tolerance) {
  constexpr double never = std::numeric_limits<double>::infinity();
  if (singular_product(p.bending, state_at(a)) >= 0) return never;
  double nearest = b;
  if (singular_product(p.bending, state_at(b)) > 0)
    nearest = first_root([&](double t) { return singular_product(p.bending, state_at(t)); }, a, b, tolerance);
  const auto inside = [&](double t) { return p.s_min - singular_distance(p.bending, state_at(t)); };
  if (inside(nearest) < 0) return never;
  return first_root(inside, a, nearest, tolerance);
}

}  // namespace bristle
