#pragma once

#include "experiment/experiment.hpp"

#include <functional>
#include <string>
#include <vector>

namespace bristle {

// A variable of the result file over the sweep's dimensions.
struct ResultVariable {
  using Value = std::function<double(const PointResult&)>;
  std::string name, long_name, symbol, equation;
  Value value;
  Value error;       // empty: no <name>_err
  Value load_error;  // the part of error from the load control; empty: none
  std::string units = "1";
};
// Those that a result of this experiment has.
std::vector<ResultVariable> result_variables(const Experiment& experiment);

// Flag meanings, in the order of PointStatus, Branch, Outcome and Phase.
extern const std::vector<std::string> kPointStatusNames, kBranchNames, kOutcomeNames, kPhaseNames;

}  // namespace bristle
