#pragma once

#include "bristle/words.hpp"
#include "experiment/experiment.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace bristle {

// What an objective asks for.
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

namespace design {

struct Objective {
  Goal goal;
  std::string variable;  // of the result
  Statistic of;
  double target;  // NaN for other goals

  std::string text() const;  // "minimise friction_coefficient (q95)"
};

// Limits of a variable of the result or of a quantity of the brush's shape at the nominal values and at all
// deviations, or of the jump margin.
struct Constraint {
  std::string variable;  // kJumpMargin, one of kShape, or one of the result
  double min, max;       // infinite: none

  std::string text() const;  // "root_strain <= 0.3"
  // Returns by how much a value exceeds the nearer limit; negative within the limits.
  double excess(double value) const { return std::max(value - max, min - value); }
  // Returns the limit that a value beyond the limits exceeds.
  double limit_of(double value) const { return value > max ? max : min; }
};
constexpr const char* kJumpMargin = "jump_margin";
constexpr const char* kClearance = "clearance";  // a design that varies it limits it

// A quantity of a brush's shape that constraints may limit.
struct ShapeQuantity {
  const char* name;
  double (*value)(const Parameters&);
};
constexpr ShapeQuantity kShape[] = {{kClearance, clearance}, {"slenderness", slenderness}};

// The block "design" of an experiment. The points of the sweep are its scenarios (docs/your-own-brush.md).
struct Design : experiment::Ranges {
  std::size_t tolerance_samples;  // 0 without tolerances
  Objective objective;
  std::vector<Constraint> constraints;
  std::size_t budget;  // trials
  std::uint64_t seed;
  double least_gain;  // over the start, relative to its value, below which the start is as good
  std::map<std::string, double> round_to;  // steps in which variables can be made; others are exact
  std::map<std::string, double> start;     // the experiment's own values of the variables that have one
};

// Returns the least and the greatest n for which n times the step lies within the bounds of the range, up to
// rounding; the least is greater if there is none.
std::pair<double, double> multiples_within(const experiment::Range& range, double step);

// Reads the block, which the experiment must have. Throws InputError for a mistake in it.
Design read_design(const Experiment& experiment);

}  // namespace design
}  // namespace bristle
