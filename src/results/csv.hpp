#pragma once

#include "results/reader.hpp"

#include <string>
#include <vector>

// Tables of a result as text, for programs without HDF5.
namespace bristle::results {

// The cell of a number: all its digits; empty for NaN.
std::string csv_number(double value);

struct CsvColumn {
  std::string name, units, meaning;
  std::vector<std::string> words;  // of codes; empty for numbers
  std::vector<double> values;      // a number for each row, or the index of its word

  // The word, or all digits of the number; empty for NaN.
  std::string cell(std::size_t row) const;
};

// A column of texts, which may be all different.
CsvColumn text_column(const std::string& name, const std::string& meaning,
                      const std::vector<std::string>& texts);

// A row for each point of the sweep (for each node of a traced curve) or for each row of a recorded table,
// with its coordinates, words for codes, and errors beside values. group: "" for the root. Throws InputError
// if the result has no such group.
std::vector<CsvColumn> csv_columns(const ResultReader& result, const std::string& group);

// Lines with # that name the result and the columns with their units, the names, and the rows.
std::string csv_text(const ResultReader& result, const std::vector<CsvColumn>& columns);

// The files that an export may replace.
FileKind csv_kind();

}  // namespace bristle::results
