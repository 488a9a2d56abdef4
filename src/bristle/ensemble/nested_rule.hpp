#pragma once

#include <vector>

namespace bristle {

// Romberg's rule of 2, 3, 5 or 9 equidistant nodes on [0, 1], exact up to degree 1, 3, 5 or 7.
struct NestedRule {
  std::vector<double> weight;
  const NestedRule* coarse;  // the rule of every second node; null for 2 nodes
  // between[i][j]: weight of the value at node 2 j in the interpolation polynomial at node 2 i + 1.
  std::vector<std::vector<double>> between;
};
const NestedRule& nested_rule(std::size_t nodes);

}  // namespace bristle
