#pragma once

#include "experiment/document.hpp"
#include "bristle/words.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace bristle {

// Of an objective.
enum class Goal {
  minimise,
  maximise,
  target
};
template <>
inline Words words<Goal>() {
  static constexpr const char* list[] = {"minimise", "maximise", "target"};
  return list;
}

// Which number stands for the values at the tolerances' deviations.
enum class Statistic {
  nominal,  // the value without deviations
  mean,
  q05,
  q95,
  least,
  greatest
};
template <>
inline Words words<Statistic>() {
  static constexpr const char* list[] = {"nominal", "mean", "q05", "q95", "least", "greatest"};
  return list;
}

namespace experiment {

struct Axis;

// A quantity that the design chooses between two values.
struct DesignVariable {
  std::string name;
  double low, high;
  bool log;  // searched evenly in the logarithm

  // The value at this share of the range, in [0, 1], to seven digits.
  double at(double share) const;
};

// How a quantity of the brush as made deviates from its nominal value, relative to it.
struct Tolerance {
  std::string name;
  bool normal;     // otherwise uniform
  double width;    // standard deviation, or greatest deviation
  double nominal;  // NaN for a variable of the design
};

struct Objective {
  Goal goal;
  std::string variable;  // of the result
  Statistic of;
  double target;  // NaN for other goals

  std::string text() const;  // "minimise friction_coefficient (q95)"
};

// Limits of a variable of the result at the nominal values and at all deviations, or of the jump margin.
struct Constraint {
  std::string variable;  // kJumpMargin, or one of the result
  double min, max;       // infinite: none

  std::string text() const;  // "root_strain <= 0.3"
};
constexpr const char* kJumpMargin = "jump_margin";

// The block "design" of an experiment. The points of the sweep are its scenarios (docs/design.md).
struct Design {
  std::vector<DesignVariable> variables;
  std::vector<Tolerance> tolerances;
  std::size_t tolerance_samples;  // 0 without tolerances
  std::vector<Objective> objectives;
  std::vector<Constraint> constraints;
  std::size_t budget;  // trials
  std::uint64_t seed;
  std::string second_choice;  // of the model, for another computation of the best trial; empty: none
  double second_option = 0;

  // 0 without this constraint.
  double jump_margin() const;
  // The variables, and the quantities with a tolerance that are no variables.
  std::vector<std::string> quantities() const;
};

// None without the block. Throws InputError.
std::optional<Design> read_design(const Document& document);

// The columns of the axis "sample" of an experiment with a design that has not been computed: the least and
// the greatest values.
std::vector<Axis> bounds_of(const Design& design);

// An axis for each quantity of the design, from the least to the greatest value that any of its points may
// have: trials, with their deviations, neighbours and profiles.
std::vector<Axis> extremes_of(const Design& design);

}  // namespace experiment
}  // namespace bristle
