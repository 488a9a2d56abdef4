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

std::vector<Compared> compared(const Trials& trials, const Findings& found) {
  std::vector<Compared> out;
  if (const Trial* start = start_of(found)) out.push_back({"start", "start", start});
  out.push_back({kRecommended, kRecommended, &found.trials[found.chosen.front()]});
  if (found.made) out.push_back({"as_made", "as made", &*found.made});
  if (found.not_worth) out.push_back({"best_other", "best other", &found.not_worth->trial});
  const std::vector<Objective>& objectives = trials.design().objectives;
  for (std::size_t o = 0; o < objectives.size() && objectives.size() > 1; ++o) {
    const auto cost_of = [&](std::size_t i) {
      return cost(objectives[o], found.trials[i].objectives[o].value);
    };
    const std::size_t best = *std::ranges::min_element(found.front, {}, cost_of);
    out.push_back(
        {fmt::format("best_objective_{}", o + 1), fmt::format("best of {}", o + 1), &found.trials[best]});
  }
  return out;
}

bool differ(const Trial& a, const Trial& b) {
  for (std::size_t o = 0; o < a.objectives.size(); ++o)
    if (std::abs(a.objectives[o].value - b.objectives[o].value) > a.point_errors[o] + b.point_errors[o])
      return true;
  return false;
}

std::vector<Gain> gains_of(const Design& design, const Findings& found, const Outcome& brush) {
  std::vector<Gain> out;
  const Trial* trial = start_of(found);
  if (!trial) return out;
  const Outcome& start =
      found.start_verification ? static_cast<const Outcome&>(*found.start_verification) : *trial;
  for (std::size_t o = 0; o < design.objectives.size(); ++o) {
    const Objective& objective = design.objectives[o];
    const Estimate &before = start.objectives[o], &after = brush.objectives[o];
    out.push_back({{cost(objective, before.value) - cost(objective, after.value), before.error + after.error},
                   start.point_errors[o] + brush.point_errors[o],
                   std::abs(before.value)});
  }
  return out;
}

bool is_worth(const Design& design, const std::vector<Gain>& gains) {
  return std::ranges::any_of(gains, [&](const Gain& gain) {
    return !gain.within_errors() && gain.difference.value >= design.least_gain * gain.scale;
  });
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

std::size_t best_within_errors(const Design& design, const std::vector<Trial>& trials,
                               std::vector<std::size_t> list) {
  for (std::size_t o = 0;; ++o) {
    const auto cost_of = [&](std::size_t i) {
      return cost(design.objectives[o], trials[i].objectives[o].value);
    };
    const std::size_t best = *std::ranges::min_element(list, {}, cost_of);
    if (o + 1 == design.objectives.size()) return best;
    std::erase_if(list, [&](std::size_t i) {
      return cost_of(i) - cost_of(best) > trials[i].objectives[o].error + trials[best].objectives[o].error;
    });
  }
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
