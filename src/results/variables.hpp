#pragma once

#include "experiment/experiment.hpp"
#include "results/tables.hpp"

#include <functional>
#include <string>
#include <vector>

namespace bristle::results {

// A variable of the result file, with one value per sweep point.
struct ResultVariable : Column {
  using Value = std::function<double(const PointResult&)>;
  Value value;
  Value error;       // written as <name>_err; empty: none
  Value load_error;  // the part of error due to the deviation of the load from its target; empty: none
};
// The variables of a result of this experiment.
std::vector<ResultVariable> result_variables(const Experiment& experiment);

// Flag meanings, in the order of PointStatus, Branch, Outcome and Phase.
extern const std::vector<std::string> kPointStatusNames, kBranchNames, kOutcomeNames, kPhaseNames;

}  // namespace bristle::results
