#pragma once

#include "ensemble/point.hpp"
#include "results/hdf5.hpp"

#include <string>
#include <utility>
#include <vector>

namespace bristle::results {

// What a dataset of a result contains: a variable over the sweep, or a column of a table.
struct Column {
  std::string name, long_name, symbol, equation;
  hid_t type = H5T_NATIVE_DOUBLE;    // in the file
  std::vector<std::string> flags{};  // meanings of the values 0, 1, ... of a flag; otherwise empty
  std::string units = "1";
  std::vector<std::pair<std::string, double>> constants{};  // used in the column's definition: attributes
  std::string ancillary{};                                  // names of variables about this one
};

// Creates the dataset with the attributes that every dataset has.
h5::Handle create_column(hid_t parent, const Column& column, const h5::Shape& shape);
void describe(hid_t dataset, const Column& column);

// Writes the values of a dataset in row-major order, in large blocks.
class BlockWriter {
 public:
  BlockWriter(h5::Handle dataset, const h5::Shape& shape);

  // The values are in the file after flush(). HDF5 converts them to the dataset's type.
  void append(const std::vector<double>& values);
  void flush();

 private:
  h5::Handle dataset_;
  std::vector<std::size_t> shape_;
  std::size_t first_ = 0;  // place of the first value that is not yet in the file
  std::vector<double> values_;
};

using Rows = std::vector<std::vector<double>>;  // by column, then by row

// Writes a table of a result: a group of columns of equal length, with a dimension scale of row numbers.
// There are bristles, trajectories and slab_force, which an experiment may record, and jumps. The first
// column in the file is "point", the index of the sweep point; table_columns(), table_rows() and
// jump_columns() omit it.
class TableWriter {
 public:
  // A table that an experiment may record.
  TableWriter(hid_t file, const std::string& name);
  // row: the name of the row numbers; columns: without "point".
  TableWriter(hid_t file, const std::string& name, const std::string& row, std::vector<Column> columns);

  // Appends rows, which are in the file after flush(). Columns of equal length, "point" first.
  void append(const Rows& rows);
  void flush();

 private:
  std::vector<BlockWriter> columns_;  // after the row numbers
  std::size_t length_ = 0;
};

std::vector<std::string> table_columns(const std::string& table);
// The rows of one point; of a table that an experiment may record.
Rows table_rows(const std::string& table, const Recorded& recorded);

}  // namespace bristle::results
