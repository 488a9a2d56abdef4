#pragma once

#include "checks/predicates.hpp"

namespace bristle {

// A word for what a check measures.
struct Predicate {
  std::string name;
  std::vector<std::string> needs;  // keys of the check beside variable and is
  bool pairs;                      // of two quantities on the same points, from "compare" or "expected"
};
const std::vector<Predicate>& vocabulary();

// What the check measures. With "compare": {axis: [first, second]}, the ratio (or, "by": "difference") of the
// measurements at the two values, or for a predicate of pairs the measurement of both together.
Measurement measure(const ResultReader& result, const Json& check);

}  // namespace bristle
