#pragma once

#include "interface/point.hpp"

#include <functional>
#include <string>
#include <vector>

namespace bristle {

// A variable of the result file over the sweep's dimensions. Dimensionless.
struct ResultVariable {
  std::string name, long_name, symbol, equation;
  std::function<double(const PointResult&)> value;
  std::function<double(const PointResult&)> error;  // empty: no <name>_err
};
const std::vector<ResultVariable>& result_variables();

// A field of the group /bristles, one value per passage.
struct BristleVariable {
  std::string name, long_name, symbol, equation;
  std::function<double(const Passage&)> value;
};
const std::vector<BristleVariable>& bristle_variables();

// Flag meanings of `status`, in the order of PointStatus, and of /bristles/status, as Outcome.
extern const std::vector<std::string> kPointStatusNames;
extern const std::vector<std::string> kOutcomeNames;

}  // namespace bristle
