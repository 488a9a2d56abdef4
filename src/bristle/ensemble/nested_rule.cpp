#include "bristle/ensemble/nested_rule.hpp"

#include <stdexcept>

namespace bristle {
namespace {

// Returns the i-th Lagrange polynomial of the nodes 0, 1, .. count - 1 at x.
double lagrange(std::size_t i, std::size_t count, double x) {
  double value = 1;
  for (std::size_t j = 0; j < count; ++j)
    if (j != i) value *= (x - double(j)) / (double(i) - double(j));
  return value;
}

NestedRule make_rule(std::vector<double> weight, const NestedRule* coarse) {
  NestedRule rule{std::move(weight), coarse, {}};
  const std::size_t even = (rule.weight.size() + 1) / 2;
  if (!coarse) return rule;
  for (std::size_t i = 0; i + 1 < even; ++i) {
    rule.between.emplace_back();
    for (std::size_t j = 0; j < even; ++j) rule.between.back().push_back(lagrange(j, even, double(i) + 0.5));
  }
  return rule;
}

}  // namespace

const NestedRule& nested_rule(std::size_t nodes) {
  static const NestedRule two = make_rule({1. / 2, 1. / 2}, nullptr);
  static const NestedRule three = make_rule({1. / 6, 4. / 6, 1. / 6}, &two);
  static const NestedRule five = make_rule({7. / 90, 32. / 90, 12. / 90, 32. / 90, 7. / 90}, &three);
  // Romberg's rule. The Newton-Cotes rule of 9 nodes has negative
  // weights, which double the noise of a rough integrand.
  constexpr double w = 5670;
  static const NestedRule nine =
      make_rule({217 / w, 1024 / w, 352 / w, 1024 / w, 436 / w, 1024 / w, 352 / w, 1024 / w, 217 / w}, &five);
  switch (nodes) {
    case 2: return two;
    case 3: return three;
    case 5: return five;
    case 9: return nine;
  }
  throw std::logic_error("quadrature rules have 2, 3, 5 or 9 nodes");
}

}  // namespace bristle
