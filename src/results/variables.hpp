#pragma once

#include "experiment/experiment.hpp"
#include "results/table.hpp"

#include <functional>
#include <string>
#include <vector>

namespace bristle {

// A variable of the result file over the sweep's dimensions. Dimensionless.
struct ResultVariable {
  using Value = std::function<double(const PointResult&)>;
  std::string name, long_name, symbol, equation;
  Value value;
  Value error;       // empty: no <name>_err
  Value load_error;  // the part of error from the load control; empty: none
};
// Those that a result of this experiment has.
std::vector<ResultVariable> result_variables(const Experiment& experiment);

// The tables that an experiment may record, and rows for them; point is the index of the sweep point.
using Rows = std::vector<std::vector<double>>;
Table bristles_table(hid_t file);
Rows bristle_rows(std::size_t point, const std::vector<Passage>& bristles);
Table slab_force_table(hid_t file);
Rows slab_force_rows(std::size_t point, const SlabForce& force);
Table trajectories_table(hid_t file);
Rows trajectory_rows(std::size_t point, const Trajectory& trajectory);

// Flag meanings, in the order of PointStatus, Branch, Outcome and Phase.
extern const std::vector<std::string> kPointStatusNames, kBranchNames, kOutcomeNames, kPhaseNames;

}  // namespace bristle
