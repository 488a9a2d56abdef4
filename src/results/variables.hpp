#pragma once

#include "experiment/experiment.hpp"
#include "results/table.hpp"

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

// The tables that an experiment may record (bristles, trajectories, slab_force), each with a first column
// "point", the index of the sweep point; and the other columns, by name and filled.
using Rows = std::vector<std::vector<double>>;
Table create_table(hid_t file, const std::string& table);
std::vector<std::string> table_columns(const std::string& table);
Rows bristle_rows(const std::vector<Passage>& bristles);
Rows slab_force_rows(const SlabForce& force);
Rows trajectory_rows(const Trajectory& trajectory);

// Flag meanings, in the order of PointStatus, Branch, Outcome and Phase.
extern const std::vector<std::string> kPointStatusNames, kBranchNames, kOutcomeNames, kPhaseNames;

}  // namespace bristle
