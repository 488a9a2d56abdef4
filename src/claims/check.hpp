#pragma once

#include "bristle/words.hpp"
#include "experiment/experiment.hpp"

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace bristle {

enum class Criterion {
  at_most,
  at_least,
  near  // within band of the threshold
};
template <>
inline Words words<Criterion>() {
  static constexpr const char* list[] = {"at_most", "at_least", "near"};
  return list;
}

namespace claims {

// Selects points by a word of a choice, a value, or a range [from, to] of values.
using Selection = std::variant<std::string, double, std::array<double, 2>>;

// Two values of an axis, or two ranges of a variable. A check measures at both and compares the measurements.
struct ComparedPair {
  std::string name;
  std::array<Selection, 2> values;
  bool operator==(const ComparedPair&) const = default;
};

// The pairs of points that a trend counts: all pairs, pairs on the same side of the jump of a curve, or pairs
// on different sides of it. The jump is the step at which z_0 rises by the largest factor.
enum class PointPairs {
  all,
  within,
  across
};

// The check of a claim of the paper, as declared by an experiment: a predicate measures one number on a
// variable of the result, which is compared with a threshold (docs/claims.md). A string is empty if its key
// is absent.
struct Check {
  std::size_t number = 0;  // in the experiment's document
  std::string claim, statement;
  // A main check decides the verdict on its claim, together with the others of the same interpretation of the
  // paper's sentence; a further one does not.
  bool main = true;
  std::string interpretation;
  std::string reading;            // value of the axis "checks_for_each" at which it is evaluated
  std::string predicate;          // a name in claims/measure.hpp
  std::string variable;           // of the result file
  std::string along, x, against;  // dimension of the curves, abscissa, second dimension
  std::vector<std::pair<std::string, double>> divide_by;  // variables and their powers
  std::vector<std::pair<std::string, Selection>> where;
  std::vector<ComparedPair> compare;  // the first values of all pairs with the second values of all
  PointPairs pairs = PointPairs::all;
  bool difference = false;          // compare by the difference; otherwise by the ratio
  bool logarithmic = true;          // for slope: of the logarithms
  bool independent_errors = false;  // errors add in quadrature
  std::optional<double> expected, resolution;
  Criterion criterion = Criterion::at_least;
  double threshold = 0;
  std::optional<double> band;

  bool operator==(const Check&) const = default;
};

// Reads the checks of an experiment; with "checks_for_each" every check once for each word of that axis,
// limited to its points. Throws InputError for a selection that is not a word, a number or a range of two
// numbers, and for an axis that is not a choice.
std::vector<Check> read_checks(const Experiment& experiment);

// Returns the JSON text of a selection, for messages.
std::string selection_text(const Selection& selection);

}  // namespace claims
}  // namespace bristle
