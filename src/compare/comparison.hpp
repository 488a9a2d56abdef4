#pragma once

#include "results/reader.hpp"
#include "util/json.hpp"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace bristle::compare {

// One side of a comparison: arrays of a result, or of a reference, which keep their values.
struct Side {
  std::string label;                                               // for messages
  std::map<std::string, const results::Array*> arrays{};           // by name
  std::map<std::string, const std::vector<double>*> tolerances{};  // of each value; unknown for other arrays
  // Arrays whose values say what the rows of a sample are; none if that is not known.
  std::optional<std::vector<const results::Array*>> sample{};
};

// Two numbers agree if they differ by at most atol + rtol * max(|a|, |b|).
struct Tolerances {
  std::optional<double> rtol, atol;
  bool given() const { return rtol || atol; }
};

// The values of a variable that differ. The sizes are the largest ones: absolute, relative and in tolerances.
// The latter is infinite for flags, for NaN or infinity against a number, and if the tolerance is zero; it is
// NaN if the tolerance is unknown. where is the index, in the first file, of the largest difference in
// tolerances, or without tolerances of the largest absolute difference; place, a and b describe this point.
struct Difference {
  std::string name;
  std::size_t values = 0, above_half = 0, above = 0;  // that differ, by more than half the tolerance, by more
  double absolute = 0, relative = 0, tolerances = 0;
  std::size_t where = 0;
  std::string place, a, b;
};

struct Comparison {
  std::string label;                    // of the second side
  std::vector<std::string> notes;       // information, not a difference
  std::vector<std::string> subsets;     // coordinates of which the second side has a part
  std::vector<std::string> failures;    // differences that have no size, so that no tolerance covers them
  std::vector<Difference> differences;  // worst first
  bool exact = false;                   // only equal numbers agree
  std::size_t values = 0;               // compared, without coordinates
  std::size_t points = 0, points_in_file = 0;

  std::size_t total(std::size_t Difference::*count) const;  // over all variables
  bool agree() const;
};

// Compares all variables of b, at its points, with those of a result. Points are found by the values of the
// coordinates, those of a sample by the values of its rows, which must all be in a. A difference of names,
// dimensions, NaN, infinity or flags is a failure. Numbers may differ by the tolerances if they are given, or
// else by the sum of the tolerances of both sides. result: the file of a, for the descriptions of points.
Comparison compare_sides(const results::ResultReader& result, const Side& a, const Side& b,
                         const Tolerances& tolerances = {});

// Two results. If no tolerance is given, only equal numbers agree, and differences are in units of the sum of
// the error estimates <name>_err of both files. Throws InputError for an invalid tolerance.
Comparison diff_results(const results::ResultReader& a, const results::ResultReader& b,
                        const Tolerances& tolerances);

// Notes, failures, a table of the differences, the remarks, and a summary in one line.
std::string comparison_text(const Comparison& comparison, const std::string& remarks = "");

// A comparison with a reference: counts, the five worst variables, failures and notes.
Json comparison_json(const Comparison& comparison);

}  // namespace bristle::compare
