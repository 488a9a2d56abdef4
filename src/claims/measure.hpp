#pragma once

#include "claims/predicates.hpp"
#include "experiment/check.hpp"
#include "results/reader.hpp"

namespace bristle::claims {

// A predicate: what a check measures, by the name that experiments use.
struct Predicate {
  const char* name;
  // A key that the check needs in addition to variable and criterion, and whether the check has it.
  struct Need {
    const char* key;
    bool (*met)(const experiment::Check&);
  };
  std::vector<Need> needs;
  // One of the two is null: a predicate measures on curves along one dimension, or on two quantities at the
  // same points.
  Measurement (*on_curves)(const CheckedCurves& curves, const experiment::Check& check);
  Measurement (*on_pairs)(const Curve& first, const Curve& second, const experiment::Check& check);
};

// All predicates. A test compares the names with the experiment schema.
const std::vector<Predicate>& predicates();
// Throws std::logic_error for a name that is not in the table.
const Predicate& find_predicate(const std::string& name);

// The number that the check measures, with its uncertainty. A check with "compare" measures at two values of
// an axis and returns the ratio or the difference of the two numbers; a predicate on pairs measures on both
// values together. Throws InputError if the result does not have a variable, an axis or a value that the
// check names.
Measurement measure(const results::ResultReader& result, const experiment::Check& check);

}  // namespace bristle::claims
