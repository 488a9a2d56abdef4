#pragma once

#include "json/json.hpp"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace bristle::json {

// A table of comma-separated values, and where its rows are in the file.
struct Table {
  Json content;  // {"columns": [names], "rows": [[numbers or texts]]}
  std::string path;
  std::size_t line_of_names = 0;
  std::vector<std::size_t> line_of_row;

  // Returns the place of a value, given its JSON pointer within the content, for messages: "t.csv: line 3".
  std::string place(const std::string& pointer) const;
};

// Reads a file of comma-separated values, whose first line names the columns. Leaves out empty lines and
// lines that begin with #, and a first column without a name, which pandas writes for its index. Throws
// InputError for a file that is no table.
Table read_table(const std::string& path);

}  // namespace bristle::json
