#pragma once

#include "design/search.hpp"
#include "design/statistics.hpp"
#include "experiment/experiment.hpp"
#include "results/record.hpp"
#include "util/sensitivity.hpp"

#include <map>
#include <string>
#include <vector>

namespace bristle::design {

using Values = std::map<std::string, double>;  // of quantities of the design, by name

constexpr std::size_t kIndexBlocks = 128;  // of the design for Sobol indices

// Computes points of a sweep, of trials or beside one; returns them in the same order.
enum class Purpose {
  trials,
  beside
};
using Solve =
    std::function<std::vector<results::PointRecord>(const Sweep&, const std::vector<std::size_t>&, Purpose)>;

struct Trial {
  Values nominal;
  std::vector<Estimate> objectives;    // values of the variables; NaN if a point that they need has none
  std::vector<std::size_t> scenarios;  // where each objective is worst
  std::vector<double> constraints;     // the value nearest to its limit, or farthest beyond; infinite: a jump
                                       // margin above its limit; NaN: not computed
  double violation;                    // the greatest, relative to the limit; infinite without values
  std::size_t missing, ambiguous;      // points
};

// What a quantity does beside a trial: nominal objectives over the values, and the nearest jumps of the gap.
struct Profile {
  std::string quantity;
  std::vector<double> values;                     // ascending
  std::vector<std::vector<Estimate>> objectives;  // by value, in the scenario where it is worst
  double margin_below, margin_above;  // relative change that reaches a jump; NaN: none among the values
};

// What many deviations of one trial show. Each is a brush that was made.
struct Verification {
  std::vector<Estimate>
      objectives;  // of the brushes with a value, in the scenario where each objective is worst
  std::vector<std::size_t> scenarios;  // by objective
  std::size_t brushes;
  std::size_t missing;   // brushes without a value of an objective or a constraint in a scenario
  std::size_t violated;  // brushes with values beyond a constraint
};

// Whether the only objective is a target, and the trial meets it within half of the value's error, or within
// a ten-thousandth of the target. One with a violation does not, nor one of which another gap carries the
// load as well at more than half of the points.
bool meets_target(const experiment::Design& design, const Trial& trial);
// The least relative change of any of the quantities that reaches a jump; infinite if none does.
double least_margin(const std::vector<Profile>& profiles);

// The trials of a design: what they are as points of a sweep, and what the points say about them.
class Trials {
 public:
  // experiment: with a design and the axis "sample", the first
  Trials(const Experiment& experiment, Solve solve);

  // The nominal values of a point of the unit cube.
  Values at(const Point& point) const;
  std::vector<Trial> evaluate(const std::vector<Values>& nominal) const;
  // Sets the value of the constraint jump_margin, and the violation if it is below its limit.
  void set_jump_margin(Trial& trial, double margin) const;
  // The least relative change of a quantity that reaches a jump, by points between the neighbours of the
  // nominal values; infinite if none up to the required margin does.
  double located_margin(const Values& nominal) const;
  // For the search: objectives are to be minimised.
  Score score_of(const Trial& trial) const;

  Profile profile(const Values& nominal, const std::string& quantity,
                  const std::vector<double>& values) const;
  // The trial with a number of deviations that shows the tails of its statistics, 256 or more. Requires
  // tolerances.
  Verification verify(const Values& nominal) const;
  // Total and first-order indices of the nominal objectives over the tolerances, by objective.
  std::vector<SobolIndices> indices(const Values& nominal) const;

  // The rows of the sample for these trials, each with the same number of rows, and the sweep of them.
  std::size_t rows_of_a_trial() const;
  std::vector<Values> rows(const std::vector<Values>& nominal) const;
  Sweep with_rows(const std::vector<Values>& rows) const;

 private:
  std::size_t scenarios() const;
  std::vector<results::PointRecord> solve_all(const Sweep& sweep, Purpose purpose) const;
  Values deviated(const Values& nominal, const Point& deviations) const;
  double neighbour(const Values& nominal, const std::string& quantity, double change) const;
  double excess(const experiment::Constraint& constraint, const results::PointRecord& record) const;
  Trial judge(const Values& nominal, const results::PointRecord* records) const;
  std::vector<double> values_beside(const Values& nominal, const std::string& quantity,
                                    std::size_t intervals) const;
  Estimate worst_nominal(const experiment::Objective& objective, const results::PointRecord* records) const;
  double jump_margin(const Values& nominal, const results::PointRecord* records) const;

  const Experiment& experiment_;
  const experiment::Design& design_;
  Solve solve_;
  std::vector<Point> deviations_;  // of tolerances, in the unit cube
};

}  // namespace bristle::design
