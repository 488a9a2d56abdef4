#pragma once

#include "results/reader.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bristle::compare {

// Two numbers agree if they differ by at most atol + rtol * max(|a|, |b|). If neither is given, only equal
// numbers agree, and differences are shown in units of the sum of the error estimates <name>_err of both
// files.
struct Tolerances {
  std::optional<double> rtol, atol;
  bool given() const { return rtol || atol; }
};

// The largest differences of a variable: absolute, relative and in units of the tolerance, each maximised
// separately. where is the index of the largest difference in units, or without units of the largest absolute
// difference.
struct Difference {
  std::string name;
  double absolute = 0, relative = 0;
  std::optional<double> units;  // none without an error estimate; infinite if the estimate is zero
  std::size_t where = 0;
  std::string place;
  double a = 0, b = 0;  // the values at index where
};

struct Diff {
  Tolerances tolerances;
  std::vector<std::string> notes;         // information, not a difference
  std::vector<std::string> incomparable;  // differences that have no size, so that no tolerance covers them
  std::vector<Difference> numbers;        // worst first
  std::size_t compared = 0, same = 0;     // variables, and those of them that are the same bit for bit

  double worst() const;  // in units
  bool agree() const;
};

// Compares all numeric datasets. Throws InputError for an invalid tolerance.
Diff diff_results(const results::ResultReader& a, const results::ResultReader& b,
                  const Tolerances& tolerances);

// One line if the files agree, otherwise the differences without a size and a table of the others.
std::string diff_text(const Diff& diff);

}  // namespace bristle::compare
