#pragma once

#include "results/reader.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bristle {

// Two numbers agree within atol + rtol * max(|a|, |b|). With neither given only equal numbers agree, and
// differences are shown in units of the files' own error estimates, <name>_err of both together.
struct Tolerances {
  std::optional<double> rtol, atol;
  bool given() const { return rtol || atol; }
};

// How the numbers of a variable differ. The sizes are the largest over the variable, each by itself; where
// is the index of the largest in units, or else of the largest absolute one.
struct Difference {
  std::string name;
  double absolute = 0, relative = 0;
  std::optional<double> units;  // none without an error estimate; infinite if that is zero
  std::size_t where = 0;
  std::string place;
  double a = 0, b = 0;  // there
};

struct Diff {
  Tolerances tolerances;
  std::vector<std::string> notes;      // what a reader should know, no difference
  std::vector<std::string> plain;      // differences that no tolerance covers
  std::vector<Difference> numbers;     // worst first
  std::size_t compared = 0, same = 0;  // variables; those that are the same bit for bit

  double worst() const;  // in units
  bool agree() const;
};

// Compares every dataset of numbers. Throws InputError for a tolerance that is none.
Diff diff_results(const ResultReader& a, const ResultReader& b, const Tolerances& tolerances);

// For people: one line where they agree, else the plain differences and a table.
std::string diff_text(const Diff& diff);

}  // namespace bristle
