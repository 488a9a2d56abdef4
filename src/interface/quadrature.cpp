#include "interface/quadrature.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>

namespace bristle {
namespace {

// Lagrange's factors for the polynomial through the Gauss nodes, at every node.
void add_interpolation(KronrodRule& rule) {
  const std::size_t n = rule.node.size();
  rule.interpolation.assign(n, std::vector<double>(n, 0));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      if (rule.gauss_weight[j] == 0) continue;
      double factor = 1;
      for (std::size_t m = 0; m < n; ++m)
        if (m != j && rule.gauss_weight[m] > 0)
          factor *= (rule.node[i] - rule.node[m]) / (rule.node[j] - rule.node[m]);
      rule.interpolation[i][j] = factor;
    }
}

template <unsigned Points>
KronrodRule make_rule() {
  using Kronrod = boost::math::quadrature::gauss_kronrod<double, Points>;
  using Gauss = boost::math::quadrature::gauss<double, (Points - 1) / 2>;
  // Boost lists the non-negative half, ascending; every second node is a Gauss node, such that the
  // largest is not.
  const auto& x = Kronrod::abscissa();
  const auto& w = Kronrod::weights();
  const auto& g = Gauss::weights();
  const std::size_t half = x.size();
  const std::size_t parity = half % 2;  // index parity of the Gauss nodes
  KronrodRule rule;
  const auto add = [&](std::size_t i, double sign) {
    rule.node.push_back(sign * x[i]);
    rule.weight.push_back(w[i]);
    rule.gauss_weight.push_back(i % 2 == parity ? g[i / 2] : 0.0);
  };
  for (std::size_t i = half; i-- > 1;) add(i, -1);
  for (std::size_t i = 0; i < half; ++i) add(i, 1);
  add_interpolation(rule);
  return rule;
}

}  // namespace

const KronrodRule& kronrod_rule(double width) {
  static const KronrodRule many = make_rule<15>(), few = make_rule<7>();
  return width > 0.7 ? many : few;
}

}  // namespace bristle
