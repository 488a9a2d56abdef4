#pragma once

#include "results/block_writer.hpp"

#include <string>
#include <utility>
#include <vector>

namespace bristle::results {

// A column of a table in a result file.
struct Column {
  std::string name, long_name, symbol, equation;
  hid_t type = H5T_NATIVE_DOUBLE;    // in the file
  std::vector<std::string> flags{};  // meanings of the values 0, 1, ... of a flag; otherwise empty
  std::string units = "1";
  std::vector<std::pair<std::string, double>> constants{};  // used in the column's definition: attributes
};

// A group of columns of equal length, with a dimension scale of row numbers. Rows can be appended.
class Table {
 public:
  Table(hid_t file, const std::string& group, const std::string& row, const std::vector<Column>& columns);

  // Appends rows, which are in the file after flush(). columns: in the order of the constructor, of equal
  // length.
  void append(const std::vector<std::vector<double>>& columns);
  void flush();
  void close();

 private:
  std::string name_;
  h5::Handle group_;
  std::vector<BlockWriter> columns_;  // after the row numbers
  std::size_t length_ = 0;
};

// Writes the attributes that every dataset has.
void describe(hid_t dataset, const std::string& long_name, const std::string& symbol,
              const std::string& equation, const std::string& units = "1");
void describe_flags(hid_t dataset, const std::vector<std::string>& names);

}  // namespace bristle::results
