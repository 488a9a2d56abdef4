#pragma once

#include "bristle/ensemble/point.hpp"
#include "results/dataset.hpp"

#include <string>
#include <vector>

// The tables that an experiment may record: bristles, trajectories and slab_force.
namespace bristle::results {

using Rows = std::vector<std::vector<double>>;  // by column, then by row

// Returns the name of a table's row numbers.
std::string row_name(const std::string& table);
// Returns the columns of a table. In the file, the column "point", the index of the sweep point, precedes
// them.
std::vector<Column> table_columns(const std::string& table);
// Returns the rows of one point, for the columns of table_columns().
Rows table_rows(const std::string& table, const Recorded& recorded);

}  // namespace bristle::results
