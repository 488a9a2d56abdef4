#pragma once

#include "claims/predicates.hpp"
#include "claims/check.hpp"
#include "results/reader.hpp"

namespace bristle::claims {

// A key that a check needs in addition to variable and criterion, and whether the check has it.
struct Need {
  const char* key;
  bool (*met)(const Check&);
};

// A predicate: what a check measures, by the name that experiments use.
struct Predicate {
  std::string name;
  const char* what;      // the measured number in words
  const char* share_of;  // what it counts, from -1, none, to 1, all; null if it is no count
  std::vector<Need> needs;
  // One of these two functions is null: a predicate measures on curves along one dimension, or on two
  // quantities at the same points.
  Measurement (*on_curves)(const CheckedCurves& curves, const Check& check);
  Measurement (*on_pairs)(const Curve& first, const Curve& second, const Check& check);
};

// Returns all predicates. docs/claims.md describes them; a test compares the names.
const std::vector<Predicate>& predicates();
std::vector<std::string> predicate_names();
// Returns the predicate of this name, which must be in the table.
const Predicate& find_predicate(const std::string& name);

// Returns the number that the check measures, with its uncertainty. A check with "compare" measures at two
// values of an axis and returns the ratio or the difference of the two numbers; a predicate on pairs measures
// on both values together. Throws InputError if the result does not have a variable, an axis or a value that
// the check names.
Measurement measure(const results::ResultReader& result, const Check& check);

}  // namespace bristle::claims
