#include "design/findings.hpp"

#include "util/units.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace bristle::design {

const Trial& recommended(const Findings& found) {
  return found.made ? *found.made : found.trials[found.chosen.front()];
}

const Trial* start_of(const Findings& found) {
  if (found.start_trial) return &found.trials[*found.start_trial];
  return found.start_outside ? &*found.start_outside : nullptr;
}

std::vector<Compared> compared(const Findings& found) {
  std::vector<Compared> out;
  if (const Trial* start = start_of(found)) out.push_back({"start", "start", start});
  out.push_back({kRecommended, kRecommended, &found.trials[found.chosen.front()]});
  if (found.made) out.push_back({"as_made", "as made", &*found.made});
  if (found.not_worth) out.push_back({"best_other", "best other", &found.not_worth->trial});
  return out;
}

bool differ(const Trial& a, const Trial& b) {
  return std::abs(a.objective.value - b.objective.value) > a.point_error + b.point_error;
}

std::optional<Gain> gain_of(const Design& design, const Findings& found, const Outcome& brush) {
  const Trial* trial = start_of(found);
  if (!trial) return {};
  const Outcome& start =
      found.start_verification ? static_cast<const Outcome&>(*found.start_verification) : *trial;
  const Quantity &before = start.objective, &after = brush.objective;
  return Gain{{cost(design.objective, before.value) - cost(design.objective, after.value),
               before.error + after.error},
              start.point_error + brush.point_error,
              std::abs(before.value)};
}

bool is_worth(const Design& design, const Gain& gain) {
  return !gain.within_errors() && gain.difference.value >= design.least_gain * gain.scale;
}

const Outcome& recommended_outcome(const Findings& found) {
  return found.verification ? static_cast<const Outcome&>(*found.verification) : recommended(found);
}

bool start_alone_violates(const Findings& found) {
  return found.start_verification && found.start_verification->violated > 0 &&
         found.verification->violated == 0;
}

std::vector<Broken> broken_constraints(const Design& design, const Findings& found) {
  std::vector<Broken> out;
  for (std::size_t c = 0; c < design.constraints.size(); ++c) {
    const Constraint& constraint = design.constraints[c];
    double value = recommended(found).constraints[c];
    const double made = recommended_outcome(found).constraints[c];
    if (constraint.excess(made) > constraint.excess(value)) value = made;
    if (constraint.excess(value) > 0)
      out.push_back(
          {c, value, constraint.limit_of(value), found.verification ? found.verification->beyond[c] : 0});
  }
  return out;
}

bool variables_matter(const Findings& found, const Trial& start) {
  return std::ranges::any_of(
      found.trials, [&](const Trial& trial) { return trial.violation == 0 && differ(start, trial); });
}

results::Column column_of(const std::string& quantity) {
  const sweep::Sweepable& s = *sweep::find_sweepable(quantity);
  results::Column out{s.name, s.description, s.symbol, ""};
  out.units = s.units;
  return out;
}

std::string label_of(const std::string& quantity) {
  return without_unit(quantity, column_of(quantity).units);
}

}  // namespace bristle::design
