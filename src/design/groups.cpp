#include "design/groups.hpp"

#include "results/variables.hpp"
#include "run/analysis.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace bristle::design {
namespace {

using results::Column;
using results::Dataset;

// Returns a table with one dimension.
Dataset table(const std::string& name, results::Array dimension) {
  Dataset out(name);
  out.add_dimension(std::move(dimension));
  return out;
}

Column integer(const std::string& name, const std::string& meaning) {
  return {name, meaning, "", "", results::Number::integer};
}

// Adds the columns objective and objective_err to a table. of(row) returns the estimate of the objective.
// nominal: the estimates are nominal values, whatever statistic counts over the tolerances.
template <class Of>
void add_objective(Dataset& table, const Trials& trials, const Of& of, bool nominal = false) {
  const std::vector<results::ResultVariable> variables = results::result_variables(trials.sweep());
  Objective objective = trials.design().objective;
  if (nominal) objective.of = Statistic::nominal;
  Column column = *std::ranges::find(variables, objective.variable, &results::ResultVariable::name);
  column.name = "objective";
  column.long_name = fmt::format("{}: {}", objective.text(), column.long_name);
  if (objective.of != Statistic::nominal) column.attributes.emplace_back("statistic", word(objective.of));
  table.add(column, [&](std::size_t row) { return of(row).value; });
  column.name += "_err";
  column.long_name = "error of " + objective.variable;
  column.attributes.clear();
  table.add(column, [&](std::size_t row) { return of(row).error; });
}

// Adds the columns that all lists of trials have. trial(row) returns the trial of a row.
template <class Of>
void add_trials(Dataset& table, const Trials& trials, const Of& trial) {
  for (const std::string& quantity : trials.design().quantities())
    table.add(column_of(quantity), [&](std::size_t row) { return trial(row).nominal.at(quantity); });
  add_objective(table, trials, [&](std::size_t row) { return trial(row).objective; });
  for (std::size_t c = 0; c < trials.design().constraints.size(); ++c)
    table.add({fmt::format("constraint_{}", c + 1), trials.design().constraints[c].text(), "", ""},
              [&](std::size_t row) { return trial(row).constraints[c]; });
}

Dataset best(const Trials& trials, const Findings& found) {
  const std::vector<std::size_t>& list = found.chosen;
  Dataset out =
      table("best", results::row_numbers("solution", "0: recommended; then other local optima", list.size()));
  out.add(integer("trial", "number of the trial"), [&](std::size_t i) { return list[i]; });
  add_trials(out, trials, [&](std::size_t i) -> const Trial& { return found.trials[list[i]]; });
  return out;
}

Dataset all_trials(const Trials& trials, const Findings& found) {
  Dataset out = table(
      "trials",
      results::row_numbers("trial", "number of the trial, in the order of the search", found.trials.size()));
  const auto trial = [&](std::size_t i) -> const Trial& { return found.trials[i]; };
  add_trials(out, trials, trial);
  out.add(
      {"violation", "greatest excess over a constraint's limit, relative; infinite without values", "", ""},
      [&](std::size_t i) { return trial(i).violation; });
  out.add(integer("first_row", "number in the sample of the point with the nominal values"),
          [&](std::size_t i) { return i * trials.rows_of_a_trial(); });
  out.add(integer("missing", "points without a value of the objective"),
          [&](std::size_t i) { return trial(i).missing; });
  out.add(integer("ambiguous", "points whose load another gap carries as well"),
          [&](std::size_t i) { return trial(i).ambiguous; });
  out.add(integer("scenario", "scenario in which the objective is worst"),
          [&](std::size_t i) { return trial(i).scenario; });
  return out;
}

// Adds the gains of brushes over the start to a table with a row for each brush; nothing without a start.
void add_gains(Dataset& table, const Trials& trials, const Findings& found,
               const std::vector<const Outcome*>& brushes) {
  const Design& design = trials.design();
  if (!start_of(found)) return;
  const auto gain = [&](std::size_t row) { return gain_of(design, found, *brushes[row])->relative(); };
  table.add({"gain", "gain over the start, relative to its value: " + design.objective.text(), "", ""},
            [&](std::size_t row) { return gain(row).value; });
  table.add({"gain_err", "error of the gain: the sum of the errors of both", "", ""},
            [&](std::size_t row) { return gain(row).error; });
}

Dataset comparison(const Trials& trials, const Findings& found) {
  const std::vector<Compared> all = compared(found);
  std::vector<std::string> names;
  for (const Compared& one : all) names.push_back(one.name);
  Dataset out = table("comparison", results::coordinates("brush", "brushes to compare", names));
  add_trials(out, trials, [&](std::size_t row) -> const Trial& { return *all[row].trial; });
  out.add({"violation", "greatest excess over a constraint's limit, relative", "", ""},
          [&](std::size_t row) { return all[row].trial->violation; });
  if (!found.verification) {
    std::vector<const Outcome*> brushes;
    for (const Compared& one : all) brushes.push_back(one.trial);
    add_gains(out, trials, found, brushes);
  }
  return out;
}

Dataset violated(const std::vector<Broken>& broken) {
  std::vector<std::string> names;
  for (const Broken& one : broken) names.push_back(fmt::format("constraint_{}", one.number + 1));
  Dataset out = table(kViolated, results::coordinates("constraint",
                                                      "constraint that the recommended brush "
                                                      "violates, as made or nominally",
                                                      names));
  out.add({"value", "value that is farthest beyond the limit", "", ""},
          [&](std::size_t row) { return broken[row].value; });
  out.add({"limit", "limit that the value exceeds", "", ""},
          [&](std::size_t row) { return broken[row].limit; });
  out.add(integer("brushes", "verified brushes beyond the limit; 0: only the trial itself is"),
          [&](std::size_t row) { return broken[row].brushes; });
  return out;
}

Dataset margins(const Findings& found) {
  std::vector<std::string> quantities;
  for (const Profile& p : found.profiles) quantities.push_back(p.quantity);
  Dataset out =
      table("margins", results::coordinates("quantity", "quantity of the recommended brush", quantities));
  out.add({"value", "value of the recommended brush, as made, from which the margins count", "", ""},
          [&](std::size_t i) { return recommended(found).nominal.at(found.profiles[i].quantity); });
  out.add(
      {"margin_below", "relative decrease that reaches a jump of the gap; NaN: none in the range", "", ""},
      [&](std::size_t i) { return found.profiles[i].margin_below; });
  out.add(
      {"margin_above", "relative increase that reaches a jump of the gap; NaN: none in the range", "", ""},
      [&](std::size_t i) { return found.profiles[i].margin_above; });
  return out;
}

Dataset verification_group(const Trials& trials, const Findings& found) {
  std::vector<std::string> names = {kRecommended};
  std::vector<const Verification*> all = {&*found.verification};
  const auto add_row = [&](const char* name, const std::optional<Verification>& verified) {
    if (!verified) return;
    names.emplace_back(name);
    all.push_back(&*verified);
  };
  add_row("start", found.start_verification);
  if (found.not_worth) add_row("best_other", found.not_worth->verification);
  Dataset out = table("verification", results::coordinates("brush", "brushes that are verified", names));
  add_objective(out, trials, [&](std::size_t row) { return all[row]->objective; });
  add_gains(out, trials, found, {all.begin(), all.end()});
  const auto add = [&](const char* name, const char* meaning, std::size_t Verification::*member) {
    out.add(integer(name, meaning), [&](std::size_t row) { return all[row]->*member; });
  };
  add("brushes", "brushes as made, each with its deviations", &Verification::brushes);
  add("missing", "brushes without a value of the objective or a constraint in a scenario",
      &Verification::missing);
  add("unloaded", "brushes of which no gap carries the load in a scenario", &Verification::unloaded);
  add("violated", "brushes with values beyond a constraint", &Verification::violated);
  add("in_contact", "brushes in contact in every scenario", &Verification::in_contact);
  add("bouncing", "brushes that bounce in every scenario", &Verification::bouncing);
  return out;
}

Dataset profile_group(const Trials& trials, const Profile& p) {
  Dataset out = table("profile_" + p.quantity, results::coordinates(column_of(p.quantity), p.values));
  add_objective(
      out, trials, [&](std::size_t i) { return p.objectives[i]; }, true);
  return out;
}

Dataset indices_group(const Trials& trials, const Findings& found) {
  Dataset out = table(
      "indices", results::coordinates("input", "quantity with a tolerance", trials.design().tolerated()));
  run::add_indices(out, {*found.indices});
  return out;
}

}  // namespace

std::vector<Dataset> groups_of(const Trials& trials, const Findings& found) {
  std::vector<Dataset> groups = {all_trials(trials, found)};
  if (found.chosen.empty()) return groups;
  groups.push_back(best(trials, found));
  groups.push_back(comparison(trials, found));
  groups.push_back(margins(found));
  for (const Profile& p : found.profiles) groups.push_back(profile_group(trials, p));
  if (found.verification) groups.push_back(verification_group(trials, found));
  if (const auto broken = broken_constraints(trials.design(), found); !broken.empty())
    groups.push_back(violated(broken));
  if (found.indices) groups.push_back(indices_group(trials, found));
  return groups;
}

}  // namespace bristle::design
