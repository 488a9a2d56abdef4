#pragma once

#include "results/reader.hpp"

#include <string>
#include <vector>

// Tables of a result as text, for programs without HDF5.
namespace bristle::results {

struct CsvColumn {
  std::string name, units, meaning;
  std::vector<std::string> cells;
};

// The cell of a number: all its digits; empty for NaN.
std::string csv_number(double value);

// A row for each point of the sweep (for each node of a traced curve) or for each row of a recorded table,
// with its coordinates, words for codes, and errors beside values. group: "" for the root. Throws InputError
// if the result has no such group.
std::vector<CsvColumn> csv_columns(const ResultReader& result, const std::string& group);

// Lines with # that name the result and the columns with their units, the names, and the rows.
std::string csv_text(const ResultReader& result, const std::vector<CsvColumn>& columns);

// The files that an export may replace.
FileKind csv_kind();

}  // namespace bristle::results
