#pragma once

#include "results/reader.hpp"

#include <string>
#include <vector>

// Tables of a result as text, for programs without HDF5.
namespace bristle::results {

// Returns a number with all digits; empty for NaN.
std::string csv_number(double value);

// Returns a row for each point of the sweep or for each row of a recorded
// table, with its coordinates, words for codes, and errors beside values. group: "" for the root. Throws
// InputError if the result has no such group.
Dataset table_of(const ResultReader& result, const std::string& group);

// Returns a table as text: lines with # that name the result and the columns with their units, a line of
// column names, and a row for each index of the arrays.
std::string csv_text(const ResultReader& result, const Dataset& table);

// Returns the kind of file that an export may replace.
FileKind csv_kind();

}  // namespace bristle::results
