#include "design/block.hpp"

#include "experiment/values.hpp"
#include "json/node.hpp"
#include "util/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace bristle::design {
namespace {

using json::Node;

constexpr double kNoTarget = std::numeric_limits<double>::quiet_NaN(),
                 kNoLimit = std::numeric_limits<double>::infinity();

Objective read_objective(const Node& node, bool tolerances) {
  Objective objective{Goal::minimise, "", tolerances ? Statistic::mean : Statistic::nominal,
                      node.get("value", kNoTarget)};
  std::size_t goals = 0;
  for (const char* goal : words<Goal>())
    if (node.has(goal)) {
      ++goals;
      objective.goal = from_word<Goal>(goal);
      objective.variable = node[goal].as<std::string>();
    }
  if (goals != 1)
    node.fail(fmt::format("{} goals are given; one is needed: minimise, maximise or target", goals));
  if (node.has("of")) objective.of = from_word<Statistic>(node["of"].as<std::string>());
  if (!tolerances && objective.of != Statistic::nominal)
    node["of"].fail(fmt::format("{} is over tolerances, and there are none", word(objective.of)));
  const bool target = objective.goal == Goal::target;
  if (target != node.has("value"))
    node["value"].fail(target ? "is missing; target needs it" : "is allowed with target only");
  return objective;
}

Constraint read_constraint(const Node& node) {
  const bool margin = node.has(kJumpMargin);
  if (margin == node.has("variable") || (margin && node.value().size() > 1))
    node.fail("needs either jump_margin alone, or a variable with min, max or both");
  if (margin) return {kJumpMargin, node[kJumpMargin].as<double>(), kNoLimit};
  const std::string variable = node["variable"].as<std::string>();
  if (!node.has("min") && !node.has("max"))
    node.fail(fmt::format("gives {} no limit; add min, max or both", variable));
  const Constraint constraint{variable, node.get("min", -kNoLimit), node.get("max", kNoLimit)};
  if (constraint.min > constraint.max)
    node.fail(fmt::format("min {} is above max {}; swap them", constraint.min, constraint.max));
  return constraint;
}

// Reads the steps of a design's variables. Throws InputError for another name, and for a step that leaves no
// value between the bounds.
void read_steps(const Node& block, Design& design) {
  std::vector<std::string> names;
  for (const experiment::Range& range : design.variables) names.push_back(range.name);
  for (const auto& [name, node] : block.members()) {
    const auto range = std::ranges::find(design.variables, name, &experiment::Range::name);
    if (range == design.variables.end())
      node.fail(fmt::format("is no variable of the design; allowed: {}", fmt::join(names, ", ")));
    const double step = design.round_to[name] = node.as<double>();
    if (const auto [least, most] = multiples_within(*range, step); least > most)
      node.fail(
          fmt::format("{} has no multiple between the bounds, {:g} and {:g}", step, range->low, range->high));
  }
}

}  // namespace

std::pair<double, double> multiples_within(const experiment::Range& range, double step) {
  constexpr double kRounding = 1e-9;  // 0.6/0.2 is less than 3
  const double low = range.low / step, high = range.high / step;
  return {std::ceil(low - kRounding * std::abs(low)), std::floor(high + kRounding * std::abs(high))};
}

std::string Objective::text() const {
  return fmt::format("{} {}{}{}", word(goal), variable,
                     goal == Goal::target ? fmt::format(" {:g}", target) : "",
                     of == Statistic::nominal ? "" : fmt::format(" ({})", word(of)));
}

std::string Constraint::text() const {
  if (!std::isfinite(max)) return fmt::format("{} >= {:g}", variable, min);
  return fmt::format("{}{} <= {:g}", std::isfinite(min) ? fmt::format("{:g} <= ", min) : "", variable, max);
}

Design read_design(const Experiment& experiment) {
  const Node block(*experiment.source, "/design"), load(*experiment.source, "/load");
  Design design;
  static_cast<experiment::Ranges&>(design) = experiment.ranges;
  const bool tolerances = !design.tolerances.empty();
  design.tolerance_samples = tolerances ? block.get("tolerance_samples", std::size_t(16)) : 0;
  design.objective = read_objective(block["objective"], tolerances);
  for (const Node& constraint : block["constraints"].elements())
    design.constraints.push_back(read_constraint(constraint));
  const auto limits_clearance = [](const Constraint& c) { return c.variable == kClearance; };
  const bool varies_clearance = std::ranges::any_of(design.quantities(), [](const std::string& name) {
    return name == "R" || name == "R_m" || name == "r0_m" || name == "spacing" || name == "spacing_m";
  });
  if (varies_clearance && std::ranges::none_of(design.constraints, limits_clearance))
    design.constraints.push_back({kClearance, 0, kNoLimit});
  design.budget = block["budget"].as<std::size_t>();
  design.seed = block.get("seed", std::uint64_t(1));
  design.least_gain = block.get("least_gain", 0.02);
  read_steps(block["round_to"], design);
  for (const experiment::Range& range : design.variables)
    if (const auto value = experiment::own_value(*experiment.source, range.name))
      design.start.emplace(range.name, *value);
  if (load.has("z_0") && design.jump_margin > 0)
    block["constraints"].fail("jump_margin needs a load R_n: at a given gap, no gap jumps");
  return design;
}

}  // namespace bristle::design
