#pragma once

#include "design/search.hpp"
#include "design/statistics.hpp"
#include "results/record.hpp"
#include "sampling/sensitivity.hpp"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace bristle::design {

using Values = std::map<std::string, double>;  // values of the design's quantities, by name

constexpr std::size_t kIndexBlocks = 128;  // blocks of Saltelli's design for Sobol indices

// Why points are computed: for trials of the search, or to look beside a trial.
enum class Purpose {
  trials,
  beside
};
// Computes points of a sweep; returns them in the same order.
using Solve =
    std::function<std::vector<results::PointRecord>(const Sweep&, const std::vector<std::size_t>&, Purpose)>;

// A computed point, and its brush.
struct Computed {
  results::PointRecord record;
  Parameters brush;
};

// Computed points over two axes: rows of the sample, and scenarios.
class Points {
 public:
  // Refers to the points of the rows, row after row; they must outlive the object.
  Points(std::span<const Computed> points, std::size_t scenarios) : points_(points), scenarios_(scenarios) {}

  std::size_t rows() const { return points_.size() / scenarios_; }
  std::size_t scenarios() const { return scenarios_; }
  const Computed& at(std::size_t row, std::size_t scenario) const {
    return points_[row * scenarios_ + scenario];
  }
  // Returns some rows.
  Points rows(std::size_t first, std::size_t count) const {
    return {points_.subspan(first * scenarios_, count * scenarios_), scenarios_};
  }
  Points row(std::size_t number) const { return rows(number, 1); }
  auto begin() const { return points_.begin(); }
  auto end() const { return points_.end(); }

 private:
  std::span<const Computed> points_;
  std::size_t scenarios_;
};

// What a trial, or its verification by many deviations, shows.
struct Outcome {
  Quantity objective{kNone, kNone};  // NaN if a point that it needs has no value
  double point_error = kNone;        // the part of the objective's error that its points have
  std::size_t scenario = 0;          // scenario in which the objective is worst
  std::vector<double> constraints;   // each value nearest to its limit, or farthest beyond; infinite: a jump
                                     // margin above its limit; NaN: not computed
};

struct Trial : Outcome {
  Values nominal;
  double violation = 0;                    // greatest excess, relative to its limit; infinite without values
  std::size_t missing = 0, ambiguous = 0;  // numbers of points
  // Variables of the objective and of constraints without a value at a point that has values, and why.
  std::map<std::string, std::string> undefined;
};

// Shows how one quantity changes a trial: the nominal objective over values of the quantity, and the nearest
// jumps of the gap.
struct Profile {
  std::string quantity;
  std::vector<double> values;         // ascending
  std::vector<Quantity> objectives;   // by value, each in its worst scenario
  double margin_below, margin_above;  // relative change that reaches a jump; NaN: none among the values
};

// Shows what many deviations of one trial do. Each deviation is a brush as made; brushes without a value are
// left out.
struct Verification : Outcome {
  std::size_t brushes = 0;
  std::size_t missing = 0;          // brushes without a value of the objective or a constraint in a scenario
  std::size_t unloaded = 0;         // brushes of which no gap carries the load in a scenario
  std::size_t violated = 0;         // brushes with values beyond a constraint
  std::vector<std::size_t> beyond;  // brushes with values beyond each constraint
  // Brushes with values that are in contact, or bounce, in every scenario.
  std::size_t in_contact = 0, bouncing = 0;
};

// Returns true if the objective is a target that the trial meets within half of the value's error, or
// within a ten-thousandth of the target. Returns false if a constraint is violated or more than half of the
// points are ambiguous.
bool meets_target(const Design& design, const Trial& trial);
// Returns the least relative change of any quantity that reaches a jump; infinite if none does.
double least_margin(const std::vector<Profile>& profiles);

// Turns trials of a design into points of a sweep, and judges the trials by the computed points.
class Trials {
 public:
  // Prepares the deviations of the trials. experiment: has "sample" as its first axis. The experiment and its
  // design must outlive the object.
  Trials(const Experiment& experiment, const Design& design, Solve solve);

  const Design& design() const { return design_; }
  const Sweep& sweep() const { return experiment_.sweep; }

  // Returns the nominal values at a point of the unit cube.
  Values at(const Point& point) const;
  // Returns the nominal values of a trial with these values of the variables.
  Values with_tolerances(Values variables) const;
  // Returns the values that can be made beside these: each variable with a step rounded down and up, in all
  // combinations, within the bounds.
  std::vector<Values> rounded_to_steps(const Values& nominal) const;
  std::vector<Trial> evaluate(const std::vector<Values>& nominal) const;
  // Sets the value of the constraint jump_margin, and the violation if the margin is below its limit.
  void set_jump_margin(Trial& trial, double margin) const;
  // Returns the least relative change of a quantity that reaches a jump, located with points between the
  // neighbours of the nominal values; infinite if no change up to the required margin does.
  double located_margin(const Values& nominal) const;
  // Returns the score of a trial for the search, which minimises the objective.
  Score score_of(const Trial& trial) const;

  Profile profile(const Values& nominal, const std::string& quantity,
                  const std::vector<double>& values) const;
  // Computes the trial with 256 to 1024 deviations, enough to show the tails of its statistics. Requires
  // tolerances.
  Verification verify(const Values& nominal) const;
  // Returns total and first-order indices of the nominal objective over the tolerances.
  SobolIndices indices(const Values& nominal) const;

  // Returns the number of rows that each trial has in the sample.
  std::size_t rows_of_a_trial() const;
  // Returns the rows of the sample for these trials.
  std::vector<Values> rows(const std::vector<Values>& nominal) const;
  // Returns the sweep with these rows as its sample.
  Sweep with_rows(const std::vector<Values>& rows) const;

 private:
  std::size_t scenarios() const;
  std::vector<Computed> solve_all(const Sweep& sweep, Purpose purpose) const;
  Values deviated(const Values& nominal, const Point& deviations) const;
  double neighbour(const Values& nominal, const std::string& quantity, double change) const;
  Trial judge(const Values& nominal, const Points& points) const;
  // Adds the variables that have no value at a point although it has values.
  void add_undefined(Trial& out, const results::PointRecord& point) const;
  // Sets the objective of an outcome from these points. present: leaves out points without a value
  void set_objective(Outcome& out, const Points& points, bool present) const;
  // Returns what these points show, whose rows are brushes.
  Verification verification_of(const Points& points) const;
  // Counts a brush, whose points in all scenarios are given.
  void add_brush(Verification& out, const Points& brush) const;
  std::vector<double> values_beside(const Values& nominal, const std::string& quantity,
                                    std::size_t intervals) const;
  Quantity worst_nominal(const Points& row) const;
  double jump_margin(const Values& nominal, const Points& points) const;

  const Experiment& experiment_;
  const Design& design_;
  Solve solve_;
  std::vector<results::ResultVariable> judged_;  // variables of the objective and constraints
  std::vector<Point> deviations_;                // points of the unit cube, by tolerance
};

}  // namespace bristle::design
