#include "design/findings.hpp"

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

bool differ_beyond_deviations(const Trial& a, const Trial& b) {
  for (std::size_t o = 0; o < a.objectives.size(); ++o)
    if (std::abs(a.objectives[o].value - b.objectives[o].value) >
        a.objectives[o].error + b.objectives[o].error)
      return true;
  return false;
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

}  // namespace bristle::design
