#pragma once

#include "ensemble/point.hpp"
#include "results/table.hpp"

#include <string>
#include <vector>

namespace bristle {

// Tables that an experiment may record: bristles, trajectories, slab_force. Their first column is "point", the
// index of the sweep point; table_columns() and the functions that fill rows leave it out.
using Rows = std::vector<std::vector<double>>;  // by column
Table create_table(hid_t file, const std::string& table);
std::vector<std::string> table_columns(const std::string& table);
Rows bristle_rows(const std::vector<Passage>& bristles);
Rows slab_force_rows(const SlabForce& force);
Rows trajectory_rows(const Trajectory& trajectory);

}  // namespace bristle
