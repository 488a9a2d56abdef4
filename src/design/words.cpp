#include "design/words.hpp"

#include "run/analysis.hpp"
#include "util/text.hpp"
#include "util/units.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <map>

namespace bristle::design {
namespace {

// Returns a value with its error, and with the digits that the error leaves, two to four.
std::string estimate_text(const Quantity& estimate) {
  if (std::isnan(estimate.value)) return "no value";
  return fmt::format("{:.{}g} +- {:.1g}", estimate.value, digits_left(estimate.value, estimate.error, 4),
                     estimate.error);
}

std::string place_of(const Trials& trials, std::size_t scenario) {
  const Sweep scenarios = trials.sweep().without(sweep::kSample);
  return scenarios.axes.empty() ? "" : " at " + scenarios.place(scenario);
}

// Returns a text such as "R = 1 mm (+- 10 %), ...".
std::string values_text(const Trials& trials, const Trial& trial) {
  std::vector<std::string> parts;
  for (const std::string& quantity : trials.design().quantities()) {
    const double value = trial.nominal.at(quantity);
    const ReadableUnit unit = readable_unit(column_of(quantity).units, value);
    std::string part = fmt::format("{} = {:.4g}{}", label_of(quantity), value / unit.size,
                                   unit.name.empty() ? "" : " " + unit.name);
    for (const experiment::Tolerance& t : trials.design().tolerances)
      if (t.name == quantity)
        part += fmt::format(" ({} {:g} %)", t.normal ? "standard deviation" : "+-", 100 * t.width);
    parts.push_back(part);
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

// Returns the objective of a trial, or of its verification, in words.
std::string objective_text(const Trials& trials, const Outcome& found) {
  return fmt::format("{}: {}{}", trials.design().objective.text(), estimate_text(found.objective),
                     place_of(trials, found.scenario));
}

std::string verification_text(const Trials& trials, const Findings& found) {
  const Verification& verified = *found.verification;
  const auto share = [&](std::size_t count) { return 100 * double(count) / double(verified.brushes); };
  std::string out = fmt::format("  of {} brushes made with these tolerances: {}\n", verified.brushes,
                                objective_text(trials, verified));
  std::vector<std::string> phases;
  const std::size_t others = verified.brushes - verified.bouncing - verified.in_contact - verified.missing;
  for (const auto& [count, what] :
       {std::pair(verified.bouncing, "bounce"), std::pair(verified.in_contact, "are in contact"),
        std::pair(others, "are between contact and bouncing, or bounce in some scenarios alone")})
    if (count > 0) phases.push_back(fmt::format("{:.3g} % {}", share(count), what));
  if (!phases.empty()) out += fmt::format("  of these brushes {}\n", fmt::join(phases, ", "));
  const bool is_counted = start_of(found) && found.chosen.front() != found.start_trial;  // beside the gain
  if (verified.unloaded > 0 && !is_counted)
    out += fmt::format("  {} of these brushes cannot carry the load\n", verified.unloaded);
  if (verified.missing > verified.unloaded)
    out += fmt::format("  {} of these brushes have no value in some scenario for another reason\n",
                       verified.missing - verified.unloaded);
  return out;
}

// Returns the constraints that the recommended brush violates, a line for each.
std::string violated_text(const Trials& trials, const Findings& found) {
  std::string out;
  for (const Broken& one : broken_constraints(trials.design(), found))
    out += fmt::format("  VIOLATES {}: {:.4g}{}\n", trials.design().constraints[one.number].text(), one.value,
                       one.brushes > 0 ? fmt::format(" in the worst case, and {} of {} brushes as made are "
                                                     "beyond the limit",
                                                     one.brushes, found.verification->brushes)
                                       : "");
  return out;
}

// Returns the comparison as a table, a row for each variable, the objective and each constraint, without
// trials that have a column already, and without the recommended trial if there is one as made.
std::string comparison_text(const Trials& trials, const Findings& found) {
  const Design& design = trials.design();
  std::vector<Compared> shown;
  for (const Compared& one : compared(found))
    if (std::ranges::count(shown, one.trial, &Compared::trial) == 0 &&
        !(found.made && one.name == kRecommended))
      shown.push_back(one);
  std::vector<std::vector<std::string>> rows = {{""}};
  for (const Compared& one : shown) rows.front().push_back(one.heading);
  const auto add = [&](const std::string& title, const auto& text) {
    rows.push_back({title});
    for (const Compared& one : shown) rows.back().push_back(text(*one.trial));
  };
  for (const std::string& name : design.quantities()) {
    const ReadableUnit unit = readable_unit(column_of(name).units, shown.front().trial->nominal.at(name));
    add(unit.name.empty() ? name : fmt::format("{} [{}]", label_of(name), unit.name),
        [&](const Trial& t) { return fmt::format("{:.5g}", t.nominal.at(name) / unit.size); });
  }
  add(design.objective.text(), [&](const Trial& t) { return estimate_text(t.objective); });
  for (std::size_t c = 0; c < design.constraints.size(); ++c)
    add(design.constraints[c].text(), [&](const Trial& t) -> std::string {
      const double value = t.constraints[c];
      // Jumps are looked for within the required margin.
      return std::isnan(value) ? "-"
                               : fmt::format("{}{:.3g}", std::isinf(value) ? "> " : "",
                                             std::isinf(value) ? design.jump_margin : value);
    });
  return aligned(rows);
}

// Returns a sentence on a start that does not meet the constraints, with the trial nearest to it that does:
// by the changes of the variables, relative to their ranges.
std::string infeasible_text(const Trials& trials, const Findings& found) {
  const Trial& start = *start_of(found);
  const auto distance = [&](const Trial& trial) {
    double sum = 0;
    for (const experiment::Range& range : trials.design().variables)
      sum += std::pow(
          (trial.nominal.at(range.name) - start.nominal.at(range.name)) / (range.high - range.low), 2);
    return trial.violation > 0 ? kInfinity : sum;
  };
  const Trial& nearest = *std::ranges::min_element(found.trials, {}, distance);
  return fmt::format("  the start {}; the nearest trial that meets the constraints: {}\n",
                     std::isinf(start.violation) ? "has points without a value" : "violates a constraint",
                     values_text(trials, nearest));
}

// Returns what the text calls a trial.
std::string name_of(const Findings& found, std::size_t trial) {
  return trial == found.start_trial ? "the start" : fmt::format("trial {}", trial);
}

// Returns the gain over the start, such as "1.9 +- 0.3 %", and how many brushes as made cannot carry the
// load, of this brush and of the start.
std::string price_text(const Trials& trials, const Findings& found, const Outcome& brush,
                       const std::optional<Verification>& verified) {
  const Gain gain = *gain_of(trials.design(), found, brush);
  std::string out;
  if (!(gain.scale > 0)) out = estimate_text(gain.difference);
  else {
    const auto [value, error, load_error] = gain.relative();
    int places = 0;  // of the error's first digit, at most 3
    for (double digit = 1; places < 3 && 100 * error < digit; digit /= 10) ++places;
    out = fmt::format("{:.{}f} +- {:.{}f} %", 100 * value, places, 100 * error, places);
  }
  if (verified)
    out +=
        fmt::format("; {} of {} brushes cannot carry the load; {} of {} of the start's", verified->unloaded,
                    verified->brushes, found.start_verification->unloaded, found.start_verification->brushes);
  return out;
}

// Returns why the start is as good as a brush that meets the constraints and does not gain enough.
std::string as_good_text(const Design& design, const Gain& gain) {
  return gain.within_errors() ? "the start is as good within the errors"
                              : fmt::format("the start is as good: nothing gains {:g} % (least_gain)",
                                            100 * design.least_gain);
}

// Returns sentences on the start, if it is recommended: why, and what the best other brush would gain.
std::string kept_text(const Trials& trials, const Findings& found) {
  if (!found.not_worth) return "  no trial is better than the start, which can be kept\n";
  const auto& [trial, verified] = *found.not_worth;
  const Outcome& brush = found.not_worth->outcome();
  const Gain gain = *gain_of(trials.design(), found, brush);
  std::string why = as_good_text(trials.design(), gain) + ", and can be kept";
  if (!variables_matter(found, *start_of(found)))
    why =
        "no trial differs from the start by more than the errors: these variables do not matter here, and "
        "the "
        "start can be kept";
  else if (gain.difference.value < -gain.point_error)
    why =
        "rounded to what can be made, the best trial is worse than the start, which can be kept: finer steps "
        "may gain more";
  return fmt::format("  {}\n  the best other brush, {}: {}\n  its gain over the start: {}\n", why,
                     name_of(found, found.not_worth_trial), values_text(trials, trial),
                     price_text(trials, found, brush, verified));
}

// Returns what the recommended brush gains over the start, and whether the start can be kept.
std::string gain_text(const Trials& trials, const Findings& found) {
  const Design& design = trials.design();
  if (found.chosen.front() == found.start_trial) return kept_text(trials, found);
  const Outcome& brush = recommended_outcome(found);
  std::string out =
      fmt::format("  gain over the start: {}\n", price_text(trials, found, brush, found.verification));
  const Gain gain = *gain_of(design, found, brush);
  if (start_of(found)->violation > 0) return out;
  if (start_alone_violates(found))
    return out + fmt::format(
                     "  {} of {} brushes made like the start violate a constraint, and none made like this\n",
                     found.start_verification->violated, found.start_verification->brushes);
  if (!is_worth(design, gain)) {
    return out + (gain.difference.value < -gain.point_error
                      ? "  the start is better, but outside the bounds of the variables: widen them, or keep "
                        "the start\n"
                      : fmt::format("  {}, and can be kept\n", as_good_text(design, gain)));
  }
  if (found.verification && gain.difference.value < gain.difference.error)
    out += fmt::format(
        "  with the same {} deviations the brush differs from the start, but each of the two by less than "
        "its "
        "own error: more tolerance_samples reduce the errors\n",
        found.verification->brushes);
  return out;
}

// Returns sentences on what the comparison means: limits that the start exceeds, whether it can be kept, and
// variables at their bounds.
std::string remarks_text(const Trials& trials, const Findings& found) {
  constexpr double at_bound = 0.01;  // of the range
  const Design& design = trials.design();
  const Trial& best = recommended(found);
  std::string out;
  const Trial* start = start_of(found);
  if (start && start->violation > 0) out += infeasible_text(trials, found);
  if (best.violation > 0)
    out +=
        "  rounded to what can be made, the brush violates a constraint: give finer steps, or tighter "
        "bounds\n";
  if (start && std::isfinite(start->violation)) out += gain_text(trials, found);
  for (const experiment::Range& range : design.variables) {
    const double value = best.nominal.at(range.name), near = at_bound * (range.high - range.low);
    if (value - range.low <= near || range.high - value <= near)
      out += fmt::format("  {} is at its {} bound: a wider range may be better\n", label_of(range.name),
                         value - range.low <= near ? "lower" : "upper");
  }
  return out;
}

std::string trials_text(std::size_t count) { return fmt::format("{} trial{}", count, count == 1 ? "" : "s"); }

std::string counts_text(const Trials& trials, const Findings& found) {
  const auto count = [&](auto is) { return std::ranges::count_if(found.trials, is); };
  std::string out = trials_text(found.trials.size() - (found.start_trial ? 1 : 0));
  if (found.start_trial) out += " and the start";
  if (!trials.design().constraints.empty())
    out += fmt::format(", {} meet the constraints", count([](const Trial& t) { return t.violation == 0; }));
  const auto missing = count([](const Trial&t) { return std::isinf(t.violation); }),
             ambiguous = count([](const Trial&t) { return t.ambiguous > 0; });
  if (missing > 0) out += fmt::format("; left out, as points have no value: {}", missing);
  if (ambiguous > 0)
    out += fmt::format("; with points whose load another gap carries as well: {}", ambiguous);
  return out;
}

// Returns a line for each variable without which trials are left out, although their points have values: why,
// and in how many trials.
std::string undefined_text(const Findings& found) {
  std::map<std::pair<std::string, std::string>, std::size_t> trials_without;
  for (const Trial& trial : found.trials)
    if (std::isinf(trial.violation))
      for (const auto& [variable, why] : trial.undefined) ++trials_without[{variable, why}];
  std::string out;
  for (const auto& [what, count] : trials_without)
    out += fmt::format("  {} has no value in {} of {}, although their points have values: {}\n", what.first,
                       count, trials_text(found.trials.size()), what.second);
  return out;
}

std::string miss_text(const Trials& trials, const Findings& found) {
  const Trial& nearest = found.trials[found.best];
  if (std::isinf(nearest.violation)) {
    const bool is_explained =
        std::ranges::none_of(found.trials, [](const Trial& t) { return t.undefined.empty(); });
    return fmt::format(
        "every trial has points without a value (its points are all scenarios, nominal and with all "
        "deviations); the {} above say why: give other {}\n",
        is_explained ? "lines" : "statuses",
        is_explained ? "bounds, or another variable" : "bounds, scenarios or tolerances");
  }
  std::vector<std::string> parts;
  for (std::size_t c = 0; c < nearest.constraints.size(); ++c)
    if (!std::isnan(nearest.constraints[c]))
      parts.push_back(
          fmt::format("{}: {:.4g}", trials.design().constraints[c].text(), nearest.constraints[c]));
  return fmt::format("no trial meets all constraints; the nearest miss is {}: {}\n  constraints: {}\n  {}\n",
                     name_of(found, found.best), values_text(trials, nearest), fmt::join(parts, "; "),
                     objective_text(trials, nearest));
}

// Returns a change that reaches a jump, such as "-11 % (2.2 standard deviations)".
std::string change_text(const Design& design, const std::string& quantity, char sign, double margin) {
  std::string out = fmt::format("{}{:.0f} %", sign, 100 * margin);
  for (const experiment::Tolerance& t : design.tolerances)
    if (t.name == quantity)
      out += fmt::format(" ({:.2g} {})", margin / t.width,
                         t.normal ? "standard deviations" : "times its tolerance");
  return out;
}

std::string margins_text(const Trials& trials, const Findings& found) {
  std::vector<std::string> parts, none;
  for (const Profile& p : found.profiles) {
    std::vector<std::string> both;
    for (const auto& [sign, margin] : {std::pair('-', p.margin_below), std::pair('+', p.margin_above)})
      if (!std::isnan(margin)) both.push_back(change_text(trials.design(), p.quantity, sign, margin));
    if (both.empty()) none.push_back(label_of(p.quantity));
    else parts.push_back(fmt::format("{} {}", label_of(p.quantity), fmt::join(both, " or ")));
  }
  if (parts.empty())
    return fmt::format("  no jump of the gap within the range of {}\n", fmt::join(none, ", "));
  return fmt::format("  the gap jumps at a change of {}{}\n", fmt::join(parts, ", "),
                     none.empty() ? "" : fmt::format("; not within the range of {}", fmt::join(none, ", ")));
}

std::string indices_text(const Trials& trials, const Findings& found) {
  if (!found.indices) return "";
  std::vector<std::string> labels;
  for (const std::string& quantity : trials.design().tolerated()) labels.push_back(label_of(quantity));
  return fmt::format("  shares of the tolerances in the variance of {} (Sobol indices)\n{}",
                     trials.design().objective.variable,
                     run::indices_text(*found.indices, labels, kIndexBlocks,
                                       "choose bounds or tolerances with which more points have a value"));
}

}  // namespace

std::string text_of(const Trials& trials, const Findings& found) {
  std::string out = counts_text(trials, found) + "\n" + undefined_text(found);
  if (found.chosen.empty()) return out + miss_text(trials, found);
  const Trial& best = recommended(found);
  out += fmt::format("recommended, {}{}: {}\n", name_of(found, found.chosen.front()),
                     found.made ? ", rounded to what can be made" : "", values_text(trials, best));
  if (!trials.sweep().without(sweep::kSample).axes.empty())
    out += fmt::format("  where it is worst: {}\n", objective_text(trials, best));
  out += violated_text(trials, found) + comparison_text(trials, found) + remarks_text(trials, found);
  if (trials.design().objective.goal == Goal::target && !meets_target(trials.design(), best))
    out +=
        "  no trial meets the target; this one is the nearest: other bounds or a larger budget may meet it\n";
  if (found.verification) out += verification_text(trials, found);
  out += margins_text(trials, found);
  return out;
}

std::string details_of(const Trials& trials, const Findings& found) {
  if (found.chosen.empty()) return "";
  std::string out = indices_text(trials, found);
  for (std::size_t i = 1; i < found.chosen.size(); ++i)
    out += fmt::format("another optimum, {}: {}\n  {}\n", name_of(found, found.chosen[i]),
                       values_text(trials, found.trials[found.chosen[i]]),
                       objective_text(trials, found.trials[found.chosen[i]]));
  return out;
}

}  // namespace bristle::design
