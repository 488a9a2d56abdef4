#include "design/trials.hpp"

#include "bristle/ensemble/normal_quantile.hpp"
#include "bristle/ensemble/phase.hpp"
#include "sampling/rounded.hpp"
#include "run/jumps.hpp"
#include "run/shard.hpp"
#include "bristle/ensemble/sobol.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace bristle::design {
namespace {

using sweep::Axis;

// Deviations of the recommended trial: at least so many, and twice as many as long as the relative error of
// the objective exceeds kVerificationError and doubling has reduced it by a twentieth.
constexpr std::size_t kVerification = 256, kMostVerification = 1024;
constexpr double kVerificationError = 0.01, kLeastGain = 0.95;
// Number of points on each side of the nominal value between which a reported jump margin is located.
constexpr std::size_t kMarginPoints = 8;

double beyond(double value, double limit) {
  return limit == 0 ? std::abs(value) : std::abs((value - limit) / limit);
}

// Returns the value at a point that a constraint limits.
double limited_value(const Constraint& constraint, const Computed& point) {
  const auto shape = std::ranges::find(kShape, constraint.variable, &ShapeQuantity::name);
  if (shape != std::end(kShape)) return shape->value(point.brush);
  return value_of(point.record, constraint.variable).value;
}

// Returns by how much the value at a point exceeds a limit; negative within the limits, infinite without a
// value.
double excess(const Constraint& constraint, const Computed& point) {
  const double value = limited_value(constraint, point);
  return std::isnan(value) ? kInfinity : constraint.excess(value);
}

// Returns the error of an estimate relative to its value; 0 without a value.
double relative_error(const Quantity& estimate) {
  return estimate.value == 0 ? 0 : std::fmax(0, estimate.error / std::abs(estimate.value));
}

}  // namespace

bool meets_target(const Design& design, const Trial& trial) {
  const Objective& objective = design.objective;
  if (objective.goal != Goal::target) return false;
  if (trial.violation > 0 || trial.ambiguous > design.tolerance_samples / 2) return false;
  const Quantity& value = trial.objective;
  return cost(objective, value.value) <=
         std::max(value.error / 2, 1e-4 * std::max(std::abs(objective.target), 1e-3));
}

double least_margin(const std::vector<Profile>& profiles) {
  double least = kInfinity;
  for (const Profile& p : profiles) least = std::fmin(least, std::fmin(p.margin_below, p.margin_above));
  return least;
}

Trials::Trials(const Experiment& experiment, const Design& design, Solve solve)
    : experiment_(experiment), design_(design), solve_(std::move(solve)) {
  for (results::ResultVariable& variable : results::result_variables(experiment.sweep))
    if (design.objective.variable == variable.name ||
        std::ranges::count(design.constraints, variable.name, &Constraint::variable) > 0)
      judged_.push_back(std::move(variable));
  if (!design_.tolerances.empty())
    deviations_ = sobol_points(design_.tolerance_samples, design_.tolerances.size(), design_.seed);
}

std::size_t Trials::scenarios() const { return experiment_.sweep.without(sweep::kSample).size(); }

std::vector<Computed> Trials::solve_all(const Sweep& sweep, Purpose purpose) const {
  std::vector<Computed> out;
  for (results::PointRecord& record : solve_(sweep, run::shard_points({}, sweep.size()), purpose))
    out.push_back({std::move(record), sweep.point(out.size()).setup.parameters});
  return out;
}

Values Trials::at(const Point& point) const {
  Values out;
  for (std::size_t i = 0; i < point.size(); ++i)
    out[design_.variables[i].name] = design_.variables[i].at(point[i]);
  return with_tolerances(std::move(out));
}

Values Trials::with_tolerances(Values variables) const {
  for (const experiment::Tolerance& t : design_.tolerances)
    if (!std::isnan(t.nominal)) variables[t.name] = t.nominal;
  return variables;
}

std::vector<Values> Trials::rounded_to_steps(const Values& nominal) const {
  std::vector<Values> out = {nominal};
  for (const auto& [name, step] : design_.round_to) {
    const auto range = std::ranges::find(design_.variables, name, &experiment::Range::name);
    const auto [least, most] = multiples_within(*range, step);
    const double steps = nominal.at(name) / step;
    std::set<double> values;
    for (const double whole : {std::floor(steps), std::ceil(steps)})
      values.insert(rounded(std::clamp(whole, least, most) * step));
    std::vector<Values> all;
    for (const Values& one : out)
      for (const double value : values) {
        all.push_back(one);
        all.back()[name] = value;
      }
    out = std::move(all);
  }
  return out;
}

Values Trials::deviated(const Values& nominal, const Point& deviations) const {
  Values out = nominal;
  for (std::size_t i = 0; i < deviations.size(); ++i) {
    const experiment::Tolerance& t = design_.tolerances[i];
    const double standard = t.normal ? normal_quantile(deviations[i]) : 2 * deviations[i] - 1;
    out[t.name] = rounded(nominal.at(t.name) * (1 + t.width * standard));
  }
  return out;
}

// Returns the value after a relative change, within the bounds of a variable of the design.
double Trials::neighbour(const Values& nominal, const std::string& quantity, double change) const {
  const double value = rounded(nominal.at(quantity) * (1 + change));
  const auto variable = std::ranges::find(design_.variables, quantity, &experiment::Range::name);
  return variable == design_.variables.end() ? value : std::clamp(value, variable->low, variable->high);
}

std::size_t Trials::rows_of_a_trial() const {
  return 1 + deviations_.size() + (design_.jump_margin > 0 ? 2 * design_.quantities().size() : 0);
}

std::vector<Values> Trials::rows(const std::vector<Values>& nominal) const {
  std::vector<Values> out;
  for (const Values& trial : nominal) {
    out.push_back(trial);
    for (const Point& deviations : deviations_) out.push_back(deviated(trial, deviations));
    if (const double margin = design_.jump_margin; margin > 0)
      for (const std::string& quantity : design_.quantities())
        for (const double change : {-margin, margin}) {
          out.push_back(trial);
          out.back()[quantity] = neighbour(trial, quantity, change);
        }
  }
  return out;
}

Sweep Trials::with_rows(const std::vector<Values>& rows) const {
  const Sweep& sweep = experiment_.sweep;
  Axis sample = sweep.axes[sweep.axis_number(sweep::kSample)];
  sample.values.resize(rows.size());
  std::iota(sample.values.begin(), sample.values.end(), 0.0);
  for (Axis& column : sample.columns) {
    column.values.clear();
    for (const Values& row : rows) column.values.push_back(row.at(column.name));
  }
  return sweep.with(sample);
}

std::vector<Trial> Trials::evaluate(const std::vector<Values>& nominal) const {
  const Sweep batch = with_rows(rows(nominal));
  const std::vector<Computed> points = solve_all(batch, Purpose::trials);
  const Points all(points, scenarios());
  std::vector<Trial> out;
  for (std::size_t i = 0; i < nominal.size(); ++i)
    out.push_back(judge(nominal[i], all.rows(i * rows_of_a_trial(), rows_of_a_trial())));
  return out;
}

void Trials::add_undefined(Trial& out, const results::PointRecord& point) const {
  if (std::isnan(value_of(point, "z_0").value)) return;
  for (const results::ResultVariable& variable : judged_)
    if (std::isnan(value_of(point, variable.name).value))
      out.undefined.try_emplace(variable.name, results::why_missing(point, variable));
}

void Trials::set_objective(Outcome& out, const Points& points, bool present) const {
  std::vector<std::vector<Quantity>> values(points.scenarios());
  for (std::size_t row = 0; row < points.rows(); ++row)
    for (std::size_t s = 0; s < points.scenarios(); ++s)
      if (const Quantity value = value_of(points.at(row, s).record, design_.objective.variable);
          !present || !std::isnan(value.value))
        values[s].push_back(value);
  std::vector<Quantity> by_scenario;
  for (const std::vector<Quantity>& all : values)
    by_scenario.push_back(all.empty() ? Quantity{kNone, kNone} : statistic(design_.objective.of, all));
  out.scenario = worst_scenario(design_.objective, by_scenario);
  out.objective = by_scenario[out.scenario];
  out.point_error = std::sqrt(mean_square_error(values[out.scenario]));
}

// Judges a trial by its points: the nominal row, rows of deviations, and rows beside the nominal values.
Trial Trials::judge(const Values& nominal, const Points& points) const {
  Trial out;
  out.nominal = nominal;
  const Points made = points.rows(0, 1 + deviations_.size());
  for (const Computed& point : made) {
    out.ambiguous += run::gap_of(point.record).undecided;
    add_undefined(out, point.record);
    out.missing += std::isnan(value_of(point.record, design_.objective.variable).value);
  }
  set_objective(out,
                design_.objective.of == Statistic::nominal ? made.row(0) : made.rows(1, deviations_.size()),
                false);
  if (std::isnan(out.objective.value)) out.violation = kInfinity;
  for (const Constraint& c : design_.constraints) {
    // The jump margin is computed below, for trials that meet the other constraints.
    double value = kNone;
    if (c.variable != kJumpMargin)
      value = limited_value(
          c, *std::ranges::max_element(made, {}, [&](const Computed& p) { return excess(c, p); }));
    out.constraints.push_back(value);
    if (c.variable == kJumpMargin) continue;
    if (std::isnan(value)) out.violation = kInfinity;
    else if (c.excess(value) > 0) out.violation = std::max(out.violation, beyond(value, c.limit_of(value)));
  }
  if (design_.jump_margin > 0 && out.violation == 0) set_jump_margin(out, jump_margin(nominal, points));
  return out;
}

void Trials::set_jump_margin(Trial& trial, double margin) const {
  for (std::size_t i = 0; i < design_.constraints.size(); ++i)
    if (design_.constraints[i].variable == kJumpMargin) trial.constraints[i] = margin;
  if (margin < design_.jump_margin) trial.violation = beyond(margin, design_.jump_margin);
}

// Returns the least relative change of a quantity that reaches a jump; infinite if no change up to the
// required margin does. Locates jumps only between neighbours whose gaps differ. points: the points of the
// trial
double Trials::jump_margin(const Values& nominal, const Points& points) const {
  double margin = kInfinity;
  const std::vector<std::string> quantities = design_.quantities();
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    bool differ = false;
    for (const std::size_t neighbour : {2 * q, 2 * q + 1})
      for (std::size_t s = 0; s < points.scenarios(); ++s)
        differ = differ || run::jumps(run::gap_of(points.at(0, s).record),
                                      run::gap_of(points.at(1 + deviations_.size() + neighbour, s).record));
    if (!differ) continue;
    margin = std::fmin(
        margin, least_margin({profile(nominal, quantities[q], values_beside(nominal, quantities[q], 1))}));
  }
  return margin;
}

double Trials::located_margin(const Values& nominal) const {
  std::vector<Profile> profiles;
  for (const std::string& quantity : design_.quantities())
    profiles.push_back(profile(nominal, quantity, values_beside(nominal, quantity, kMarginPoints)));
  return least_margin(profiles);
}

// Returns values of a quantity from its lower to its upper neighbour, with `intervals` intervals on each side
// of the nominal value.
std::vector<double> Trials::values_beside(const Values& nominal, const std::string& quantity,
                                          std::size_t intervals) const {
  std::vector<double> values;
  for (std::size_t i = 0; i <= 2 * intervals; ++i)
    values.push_back(neighbour(nominal, quantity, design_.jump_margin * (double(i) / double(intervals) - 1)));
  std::ranges::sort(values);  // the values of a negative quantity descend
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

// Returns the value in the scenario where the objective is worst. row: one row of points
Quantity Trials::worst_nominal(const Points& row) const {
  std::vector<Quantity> by_scenario;
  for (const Computed& point : row) by_scenario.push_back(value_of(point.record, design_.objective.variable));
  return by_scenario[worst_scenario(design_.objective, by_scenario)];
}

Score Trials::score_of(const Trial& trial) const {
  return {cost(design_.objective, trial.objective.value), trial.violation, meets_target(design_, trial)};
}

Profile Trials::profile(const Values& nominal, const std::string& quantity,
                        const std::vector<double>& values) const {
  const Sweep single = with_rows({nominal});
  Axis sample = single.axes[single.axis_number(sweep::kSample)];
  std::erase_if(sample.columns, [&](const Axis& column) { return column.name == quantity; });
  const Sweep along = (sample.columns.empty() ? single.without(sweep::kSample) : single.with(sample))
                          .with({quantity, values});
  const std::vector<Computed> points = solve_all(along, Purpose::beside);

  Profile out{quantity, values, {}, kNone, kNone};
  const Points all(points, scenarios());
  for (std::size_t row = 0; row < all.rows(); ++row) out.objectives.push_back(worst_nominal(all.row(row)));
  if (along.base.loading.z_0) return out;  // a given gap does not jump
  std::vector<run::Gap> gaps;
  for (const Computed& point : points) gaps.push_back(run::gap_of(point.record));
  const results::Rows jumps = run::locate_jumps(
      along, quantity, gaps, [&](const Sweep& between, const std::vector<std::size_t>& indices) {
        std::vector<run::Gap> found;
        for (const results::PointRecord& record : solve_(between, indices, Purpose::beside))
          found.push_back(run::gap_of(record));
        return found;
      });
  const double x = nominal.at(quantity);
  const std::vector<double>&before = jumps[1], &after = jumps[2];
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double change = ((before[i] + after[i]) / 2 - x) / x;  // to the middle of the interval
    double& margin = change < 0 ? out.margin_below : out.margin_above;
    if (!(margin <= std::abs(change))) margin = std::abs(change);
  }
  return out;
}

Verification Trials::verify(const Values& nominal) const {
  std::vector<Computed> points;
  const auto compute = [&](std::size_t brushes) {
    const std::vector<Point> deviations = sobol_points(brushes, design_.tolerances.size(), design_.seed);
    std::vector<Values> rows;
    for (std::size_t row = points.size() / scenarios(); row < brushes; ++row)
      rows.push_back(deviated(nominal, deviations[row]));
    std::ranges::move(solve_all(with_rows(rows), Purpose::beside), std::back_inserter(points));
    return verification_of({points, scenarios()});
  };
  Verification out = compute(std::max(kVerification, design_.tolerance_samples));
  double before = kInfinity;
  for (double error = relative_error(out.objective);
       error > kVerificationError && error < kLeastGain * before && out.brushes < kMostVerification;
       error = relative_error(out.objective)) {
    before = error;
    out = compute(2 * out.brushes);
  }
  return out;
}

Verification Trials::verification_of(const Points& points) const {
  Verification out;
  out.brushes = points.rows();
  out.constraints.resize(design_.constraints.size(), kNone);
  out.beyond.resize(design_.constraints.size(), 0);
  for (std::size_t row = 0; row < out.brushes; ++row) add_brush(out, points.row(row));
  set_objective(out, points, true);
  return out;
}

void Trials::add_brush(Verification& out, const Points& brush) const {
  const auto all_in = [&](BrushPhase phase) {
    return std::ranges::all_of(
        brush, [&](const Computed& p) { return value_of(p.record, "phase").value == double(phase); });
  };
  bool missing = false, unloaded = false, violated = false;
  for (const Computed& point : brush) {
    unloaded = unloaded || value_of(point.record, "status").value == double(PointStatus::unreachable);
    missing = missing || std::isnan(value_of(point.record, design_.objective.variable).value);
    for (const Constraint& c : design_.constraints)
      missing = missing || (c.variable != kJumpMargin && std::isinf(excess(c, point)));
  }
  out.missing += missing;
  out.unloaded += unloaded;
  if (missing) return;
  for (std::size_t i = 0; i < design_.constraints.size(); ++i) {
    const Constraint& c = design_.constraints[i];
    if (c.variable == kJumpMargin) continue;
    const double value = limited_value(
        c, *std::ranges::max_element(brush, {}, [&](const Computed& p) { return excess(c, p); }));
    if (!(c.excess(value) <= c.excess(out.constraints[i]))) out.constraints[i] = value;
    out.beyond[i] += c.excess(value) > 0;
    violated = violated || c.excess(value) > 0;
  }
  out.violated += violated;
  out.in_contact += all_in(BrushPhase::contact);
  out.bouncing += all_in(BrushPhase::bouncing);
}

SobolIndices Trials::indices(const Values& nominal) const {
  const std::size_t inputs = design_.tolerances.size();
  std::vector<Values> rows;
  for (const Point& deviations : saltelli_design(kIndexBlocks, inputs, design_.seed))
    rows.push_back(deviated(nominal, deviations));
  const Sweep batch = with_rows(rows);
  const std::vector<Computed> points = solve_all(batch, Purpose::beside);
  const Points all(points, scenarios());
  std::vector<double> values;
  for (std::size_t row = 0; row < all.rows(); ++row) values.push_back(worst_nominal(all.row(row)).value);
  return sobol_indices(values, inputs);
}

}  // namespace bristle::design
