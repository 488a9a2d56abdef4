#pragma once

#include "checks/predicates.hpp"
#include "experiment/check.hpp"
#include "results/reader.hpp"

namespace bristle {

// A predicate: what a check measures, by the name that experiments use.
struct Predicate {
  const char* name;
  // A key that the check needs beside variable and criterion, and whether the check has it.
  struct Need {
    const char* key;
    bool (*met)(const Check&);
  };
  std::vector<Need> needs;
  // Measures on curves along one dimension, or on pairs of quantities at the same points; the other is null.
  Measurement (*on_curves)(const CheckedCurves& curves, const Check& check);
  Measurement (*on_pairs)(const Curve& first, const Curve& second, const Check& check);
};

// All predicates. The experiment schema lists the same names, which a test compares.
const std::vector<Predicate>& predicates();
// Throws std::logic_error for a name that is not in the table.
const Predicate& find_predicate(const std::string& name);

// The number that the check measures, with its uncertainty. A check with "compare" measures at two values of an
// axis: the result is the ratio or the difference of the two, or for a predicate of pairs the measurement of
// both together. Throws InputError if the result lacks what the check names.
Measurement measure(const ResultReader& result, const Check& check);

}  // namespace bristle
