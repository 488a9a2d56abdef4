#pragma once

#include "results/reader.hpp"
#include "json/json.hpp"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace bristle::compare {

// One side of a comparison: arrays of a result or of a reference, which must outlive the side.
struct Side {
  std::string label;                                               // for messages
  std::map<std::string, const results::Array*> arrays{};           // by name
  std::map<std::string, const std::vector<double>*> tolerances{};  // by name; unknown for other arrays
  // Arrays whose values identify the rows of a sample; none if these arrays are not known.
  std::optional<std::vector<const results::Array*>> sample{};
};

// Two numbers agree if they differ by at most atol + rtol * max(|a|, |b|).
struct Tolerances {
  std::optional<double> rtol, atol;
  bool given() const { return rtol || atol; }
};

// The values of a variable that differ. absolute, relative and tolerances are the largest differences:
// absolute, relative, and in units of the tolerance. tolerances is infinite for flags, for NaN or infinity
// against a number, and if the tolerance is zero; it is NaN if the tolerance is unknown. where is the index,
// in the first file, of the largest difference in tolerances, or without tolerances of the largest absolute
// difference; place, a and b describe this point.
struct Difference {
  std::string name;
  // Numbers of values that differ, that differ by more than half the tolerance, and by more than the
  // tolerance.
  std::size_t values = 0, above_half = 0, above = 0;
  double absolute = 0, relative = 0, tolerances = 0;
  std::size_t where = 0;
  std::string place, a, b;
};

struct Comparison {
  std::string label;                    // label of the second side
  std::vector<std::string> notes;       // information, not a difference
  std::vector<std::string> subsets;     // coordinates that the second side has in part
  std::vector<std::string> failures;    // differences without a size, which no tolerance covers
  std::vector<Difference> differences;  // worst first
  bool exact = false;                   // only equal numbers agree
  std::size_t values = 0;               // number of compared values, without coordinates
  std::size_t points = 0, points_in_file = 0;

  std::size_t total(std::size_t Difference::*count) const;  // sum over all variables
  bool agree() const;
};

// Compares all variables of b, at the points of b, with the variables of a. Finds points by the values of
// their coordinates, and points of a sample by the values of its rows; a must have all of them. A difference
// of names, dimensions, NaN, infinity or flags is a failure. Numbers may differ by the given tolerances or,
// if none are given, by the sum of the tolerances of both sides. result: the file of a, for the descriptions
// of points
Comparison compare_sides(const results::ResultReader& result, const Side& a, const Side& b,
                         const Tolerances& tolerances = {});

// Compares two results. If no tolerance is given, only equal numbers agree, and differences are in units of
// the sum of the error estimates <name>_err of both files. Throws InputError for an invalid tolerance.
Comparison diff_results(const results::ResultReader& a, const results::ResultReader& b,
                        const Tolerances& tolerances);

// Returns notes, failures, a table of the differences, the remarks, and a summary in one line.
std::string comparison_text(const Comparison& comparison, const std::string& remarks = "");

// Returns a comparison with a reference as JSON: counts, the five worst variables, failures and notes.
Json comparison_json(const Comparison& comparison);

}  // namespace bristle::compare
