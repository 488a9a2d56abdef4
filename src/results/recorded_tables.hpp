#pragma once

#include "ensemble/point.hpp"
#include "results/table.hpp"

#include <string>
#include <vector>

namespace bristle::results {

// Tables that an experiment may record: bristles, trajectories, slab_force. The first column of a table in
// the file is "point", the index of the sweep point; table_columns() and the *_rows() functions omit it.
using Rows = std::vector<std::vector<double>>;  // by column, then by row
Table create_table(hid_t file, const std::string& table);
std::vector<std::string> table_columns(const std::string& table);
Rows bristle_rows(const std::vector<Passage>& bristles);
Rows slab_force_rows(const SlabForce& force);
Rows trajectory_rows(const Trajectory& trajectory);

}  // namespace bristle::results
