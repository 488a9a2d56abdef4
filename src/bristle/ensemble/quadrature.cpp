#include "bristle/ensemble/quadrature.hpp"

#include "bristle/ensemble/nested_rule.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

namespace bristle {

// Distance of the nodes beside a jump below which the jump is not bisected further.
constexpr double kSmallestPanel = 1e-7;
constexpr double kRounding = 1e-15;   // relative rounding error of the sum over the panels
constexpr std::size_t kMaxNodes = 9;  // in a panel that is not alternating
// Factor on the error estimates of rough panels. Panels whose estimate is small by accident are not refined
// further, so that the total error is biased; the factor makes up for it (calibrated in docs/numerics.md).
constexpr double kRoughnessFactor = 1;

std::vector<Quadrature::Node> Quadrature::evaluate(const std::vector<double>& at) {
  std::vector<double> missing;
  std::ranges::copy_if(at, std::back_inserter(missing), [&](double x) { return !kept_.contains(x); });
  const std::vector<Sample> samples = missing.empty() ? std::vector<Sample>() : f_(missing);
  result_.samples += long(missing.size());
  std::vector<Node> nodes;
  auto computed = samples.begin();
  for (const double x : at) {
    const auto kept = kept_.find(x);
    nodes.push_back({x, kept == kept_.end() ? *computed++ : kept->second});
    if (!nodes.back().sample.valid) result_.status = QuadratureStatus::invalid;
  }
  return nodes;
}

// Returns the 5 nodes of the initial panel with this index.
std::vector<double> Quadrature::initial_nodes(std::size_t panel) const {
  constexpr std::size_t steps = kMaxNodes / 2;
  std::vector<double> at;
  for (std::size_t i = 0; i < steps; ++i)
    at.push_back(edges_[panel] + (edges_[panel + 1] - edges_[panel]) * double(i) / steps);
  at.push_back(edges_[panel + 1]);
  return at;
}

// Samples the initial panels in one batch.
void Quadrature::sample_initial_panels() {
  constexpr std::size_t steps = kMaxNodes / 2;
  std::vector<double> at = {edges_.front()};
  for (std::size_t panel = 0; panel + 1 < edges_.size(); ++panel) {
    const std::vector<double> nodes = initial_nodes(panel);
    at.insert(at.end(), nodes.begin() + 1, nodes.end());
  }
  const std::vector<Node> nodes = evaluate(at);
  for (std::size_t first = 0; first + steps < nodes.size(); first += steps) {
    panels_.push_back(make_panel({nodes.begin() + first, nodes.begin() + first + steps + 1}));
    panels_.back().initial = true;
  }
}

// Returns the integral over the panel by the rule of every stride-th node.
Quadrature::Values Quadrature::rule(const Panel& panel, std::size_t stride) const {
  const NestedRule& r = nested_rule((panel.nodes.size() - 1) / stride + 1);
  Values integral{};
  for (std::size_t i = 0; i < r.weight.size(); ++i)
    for (std::size_t k = 0; k < OBSERVABLES; ++k)
      integral[k] += panel.width() * r.weight[i] * panel.nodes[i * stride].sample.value[k];
  return integral;
}

void Quadrature::evaluate_panel(Panel& panel) const {
  if (panel.alternating) return evaluate_alternating(panel);
  const std::size_t n = panel.nodes.size();
  const auto value = [&](std::size_t i, std::size_t k) { return panel.nodes[i].sample.value[k]; };
  panel.integral = rule(panel, 1);
  if (n == 2) {
    for (std::size_t k = 0; k < OBSERVABLES; ++k)
      panel.error[k] = std::abs(value(1, k) - value(0, k)) * panel.width() / 2;
    return;
  }
  const NestedRule& r = nested_rule(n);
  const Values coarse = rule(panel, 2);
  for (std::size_t k = 0; k < OBSERVABLES; ++k) {
    double mean = 0, spread = 0, misfit = 0;
    for (std::size_t i = 0; i < n; ++i) mean += value(i, k) / double(n);
    for (std::size_t i = 0; i < n; ++i) spread += (value(i, k) - mean) * (value(i, k) - mean) / double(n);
    for (std::size_t i = 0; i < r.between.size(); ++i) {
      double between = 0;
      for (std::size_t j = 0; j < r.between[i].size(); ++j) between += r.between[i][j] * value(2 * j, k);
      const double deviation = value(2 * i + 1, k) - between;
      misfit += deviation * deviation / double(n);
    }
    const double roughness = spread > 0 ? std::min(1.0, std::sqrt(misfit / spread)) : 0;
    const double difference = std::abs(panel.integral[k] - coarse[k]);
    panel.error[k] = std::max(difference, kRoughnessFactor * roughness * std::sqrt(misfit) * panel.width());
  }
}

Quadrature::Panel Quadrature::make_panel(std::vector<Node> nodes) const {
  Panel panel{.nodes = std::move(nodes)};
  evaluate_panel(panel);
  return panel;
}

// Evaluates, in one batch, the middles between the nodes of these panels and of these jumps. A panel with too
// many nodes is then split, unless it is alternating.
void Quadrature::refine_in_batch(const std::vector<std::size_t>& panels,
                                 const std::vector<std::size_t>& jumps) {
  const auto middle = [](const Node& left, const Node& right) { return left.at + (right.at - left.at) / 2; };
  std::vector<double> at;
  for (const std::size_t i : panels)
    for (std::size_t k = 1; k < panels_[i].nodes.size(); ++k)
      at.push_back(middle(panels_[i].nodes[k - 1], panels_[i].nodes[k]));
  for (const std::size_t i : jumps) at.push_back(middle(jumps_[i].left, jumps_[i].right));
  const std::vector<Node> added = evaluate(at);

  auto next = added.begin();
  std::vector<Panel> kept;
  for (std::size_t i = 0; i < panels_.size(); ++i) {
    if (!std::binary_search(panels.begin(), panels.end(), i)) {
      kept.push_back(std::move(panels_[i]));
      continue;
    }
    std::vector<Node> nodes{panels_[i].nodes.front()};
    for (std::size_t k = 1; k < panels_[i].nodes.size(); ++k) {
      nodes.push_back(*next++);
      nodes.push_back(panels_[i].nodes[k]);
    }
    if (panels_[i].alternating) {
      kept.push_back({.nodes = std::move(nodes), .alternating = true});
      evaluate_panel(kept.back());
    } else {
      append_panels(kept, nodes, false);
    }
  }
  for (const std::size_t i : jumps) {
    LabelChange& jump = jumps_[i];
    const bool on_left = next->sample.label == jump.left.sample.label;
    kept.push_back(on_left ? make_panel({jump.left, *next}) : make_panel({*next, jump.right}));
    (on_left ? jump.left : jump.right) = *next++;
  }
  panels_ = std::move(kept);
  sort_panels();
}

void Quadrature::sort_panels() {
  std::sort(panels_.begin(), panels_.end(),
            [](const Panel& a, const Panel& b) { return a.nodes.front().at < b.nodes.front().at; });
}

std::vector<Quadrature::LabelChange> Quadrature::changes_in(const Panel& panel) {
  std::vector<LabelChange> changes;
  if (panel.alternating) return changes;
  for (std::size_t i = 1; i < panel.nodes.size(); ++i)
    if (panel.nodes[i - 1].sample.label != panel.nodes[i].sample.label)
      changes.push_back({panel.nodes[i - 1], panel.nodes[i], {}, panel.nodes[i].at - panel.nodes[i - 1].at});
  if (changes.empty()) return changes;
  Values spread{};
  for (std::size_t k = 0; k < OBSERVABLES; ++k) {
    const auto [least, most] =
        std::ranges::minmax_element(panel.nodes, {}, [k](const Node& node) { return node.sample.value[k]; });
    spread[k] = most->sample.value[k] - least->sample.value[k];
  }
  for (LabelChange& change : changes) change.spread = spread;
  return changes;
}

std::optional<Quadrature::LabelChange> Quadrature::largest_change(const Panel& panel) const {
  std::optional<LabelChange> worst;
  double largest = -1;
  for (const LabelChange& change : changes_in(panel))
    if (const double s = severity(uncertainty(change)); s > largest) {
      largest = s;
      worst = change;
    }
  return worst;
}

Quadrature::Values Quadrature::uncertainty(const LabelChange& change) {
  Values error;
  for (std::size_t k = 0; k < OBSERVABLES; ++k)
    error[k] = change.spread[k] * (change.right.at - change.left.at) / 2;
  return error;
}

// Appends panels for equidistant nodes to `out`, each panel as large as possible, starting from the left or
// from the right.
void Quadrature::append_panels(std::vector<Panel>& out, const std::vector<Node>& nodes,
                               bool from_right) const {
  std::size_t from = 0, to = nodes.size() - 1;
  std::vector<Panel> panels;
  while (from < to) {
    std::size_t steps = 1;
    while (steps < kMaxNodes - 1 && 2 * steps <= to - from) steps *= 2;
    const std::size_t first = from_right ? to - steps : from;
    panels.push_back(make_panel(
        {nodes.begin() + std::ptrdiff_t(first), nodes.begin() + std::ptrdiff_t(first + steps) + 1}));
    (from_right ? to : from) = from_right ? first : first + steps;
  }
  if (from_right) std::reverse(panels.begin(), panels.end());
  out.insert(out.end(), panels.begin(), panels.end());
}

// Replaces these panels by panels on both sides of the largest change in each, which becomes a jump.
void Quadrature::split_at_changes(const std::vector<std::size_t>& panels) {
  std::vector<Panel> sides;
  for (const std::size_t i : panels) {
    const std::vector<Node>& nodes = panels_[i].nodes;
    const LabelChange jump = *largest_change(panels_[i]);
    const auto right =
        std::find_if(nodes.begin(), nodes.end(), [&](const Node& n) { return n.at == jump.right.at; });
    append_panels(sides, {nodes.begin(), right}, false);
    append_panels(sides, {right, nodes.end()}, true);
    jumps_.push_back(jump);
  }
  for (auto i = panels.rbegin(); i != panels.rend(); ++i) panels_.erase(panels_.begin() + std::ptrdiff_t(*i));
  panels_.insert(panels_.end(), sides.begin(), sides.end());
  sort_panels();
}

Quadrature::Values Quadrature::squares(const Values& error) {
  Values out;
  for (std::size_t k = 0; k < OBSERVABLES; ++k) out[k] = error[k] * error[k];
  return out;
}

// Returns the squares of the errors of a panel, including the uncertain positions of the label changes in it.
Quadrature::Values Quadrature::squares(const Panel& panel) {
  Values out = squares(panel.error);
  for (const LabelChange& change : changes_in(panel)) {
    const Values more = squares(uncertainty(change));
    for (std::size_t k = 0; k < OBSERVABLES; ++k) out[k] += more[k];
  }
  return out;
}

void Quadrature::sum() {
  result_.integral = complete_ = {};
  Values total{};
  const auto add = [](Values& to, const Values& part) {
    for (std::size_t k = 0; k < OBSERVABLES; ++k) to[k] += part[k];
  };
  for (const Panel& panel : panels_) {
    add(result_.integral, panel.integral);
    add(total, squares(panel));
    if (is_complete(panel)) add(complete_, squares(panel));
  }
  for (const LabelChange& jump : jumps_) {
    const double width = jump.right.at - jump.left.at;
    for (std::size_t k = 0; k < OBSERVABLES; ++k)
      result_.integral[k] += width * (jump.left.sample.value[k] + jump.right.sample.value[k]) / 2;
    add(total, squares(uncertainty(jump)));
  }
  for (std::size_t k = 0; k < OBSERVABLES; ++k)
    result_.error[k] = std::sqrt(total[k]) + kRounding * std::abs(result_.integral[k]);
}

std::optional<QuadratureResult> Quadrature::difference_to(const Quadrature& other) const {
  std::map<double, const Values*> values;
  for (const Panel& panel : other.panels_)
    for (const Node& node : panel.nodes) values[node.at] = &node.sample.value;
  for (const LabelChange& jump : other.jumps_)
    for (const Node* node : {&jump.left, &jump.right}) values[node->at] = &node->sample.value;
  bool common = true;
  const auto subtract = [&](Node& node) {
    const auto found = values.find(node.at);
    common = common && found != values.end();
    if (!common) return;
    for (std::size_t k = 0; k < OBSERVABLES; ++k)
      node.sample.value[k] = (*found->second)[k] - node.sample.value[k];
  };
  Quadrature difference = *this;
  for (Panel& panel : difference.panels_) {
    for (Node& node : panel.nodes) subtract(node);
    evaluate_panel(panel);
  }
  for (LabelChange& jump : difference.jumps_) {
    subtract(jump.left);
    subtract(jump.right);
    for (std::size_t k = 0; k < OBSERVABLES; ++k)
      jump.spread[k] = std::abs(jump.right.sample.value[k] - jump.left.sample.value[k]);
  }
  if (!common) return {};
  difference.sum();
  return difference.result_;
}

// Returns whether the panel is alternating and has the maximum number of nodes.
bool Quadrature::is_complete(const Panel& panel) const {
  return panel.alternating && panel.nodes.size() >= goal_.most_alternating;
}

// Returns the error of the component k that the goal allows.
double Quadrature::asked(std::size_t k) const {
  const double relative = goal_.rtol[k] * std::abs(result_.integral[goal_.scale[k]]);
  if (!goal_.threshold) return relative;
  return std::max(relative, std::abs(result_.integral[k] - *goal_.threshold) / 4);
}

// Returns the error of the component k to which the panels and jumps are refined: what the goal allows, in
// addition to the errors of complete panels, which cannot be reduced.
double Quadrature::tolerance(std::size_t k) const {
  return complete_[k] > 0 ? std::sqrt(asked(k) * asked(k) + complete_[k]) : asked(k);
}

// Returns the largest ratio of an error to the tolerance of its component.
double Quadrature::severity(const Values& error) const {
  double worst = 0;
  for (std::size_t k = 0; k < OBSERVABLES; ++k) {
    if (goal_.rtol[k] == 0 || error[k] == 0) continue;
    worst = std::max(worst, error[k] / tolerance(k));
  }
  return worst;
}

// Returns the severity of an error among the components whose total error exceeds the tolerance.
double Quadrature::unmet_severity(Values error) const {
  for (std::size_t k = 0; k < OBSERVABLES; ++k)
    if (result_.error[k] <= tolerance(k)) error[k] = 0;
  return severity(error);
}

double Quadrature::unmet_severity(const Panel& panel) const {
  const double own = unmet_severity(panel.error);
  const auto change = largest_change(panel);
  return change ? std::max(own, unmet_severity(uncertainty(*change))) : own;
}

// Returns the panels and jumps with the largest unmet severities: the fewest whose removal would meet the
// goal, and at least one. Returns none if no error can be reduced.
Quadrature::Selection Quadrature::largest() const {
  struct Part {
    double severity;
    Values squares;
    std::size_t index;
    bool is_jump;
  };
  std::vector<Part> parts;
  for (std::size_t i = 0; i < panels_.size(); ++i)
    if (!is_complete(panels_[i]))
      parts.push_back({unmet_severity(panels_[i]), squares(panels_[i]), i, false});
  for (std::size_t i = 0; i < jumps_.size(); ++i)
    if (jumps_[i].right.at - jumps_[i].left.at > kSmallestPanel)
      parts.push_back({unmet_severity(uncertainty(jumps_[i])), squares(uncertainty(jumps_[i])), i, true});
  std::stable_sort(parts.begin(), parts.end(),
                   [](const Part& a, const Part& b) { return a.severity > b.severity; });

  Values left = squares(result_.error);
  const auto met = [&] {
    for (std::size_t k = 0; k < OBSERVABLES; ++k)
      if (goal_.rtol[k] > 0 && left[k] > tolerance(k) * tolerance(k)) return false;
    return true;
  };
  Selection chosen;
  for (const Part& part : parts) {
    const bool none = chosen.panels.empty() && chosen.jumps.empty();
    if (part.severity == 0 || (met() && !none)) break;
    (part.is_jump ? chosen.jumps : chosen.panels).push_back(part.index);
    for (std::size_t k = 0; k < OBSERVABLES; ++k) left[k] -= part.squares[k];
  }
  std::sort(chosen.panels.begin(), chosen.panels.end());
  return chosen;
}

// Returns the panels beside these jumps that the first two bisections of the jumps have left there. A node in
// the middle of such a panel shows whether the label changes only once.
std::vector<std::size_t> Quadrature::beside(const std::vector<std::size_t>& jumps) const {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < panels_.size(); ++i) {
    const Panel& panel = panels_[i];
    const auto left_by = [&](const LabelChange& jump) {
      const bool adjacent = panel.nodes.back().at == jump.left.at || panel.nodes.front().at == jump.right.at;
      return adjacent && panel.width() > jump.gap / 5;
    };
    if (panel.nodes.size() == 2 &&
        std::ranges::any_of(jumps, [&](std::size_t j) { return left_by(jumps_[j]); }))
      out.push_back(i);
  }
  return out;
}

// Refines the panels and narrows the jumps with the largest errors. Initial panels first get all their nodes.
void Quadrature::refine_largest() {
  const Selection chosen = largest();
  if (chosen.panels.empty() && chosen.jumps.empty()) {
    result_.status = QuadratureStatus::not_converged;
    return;
  }
  std::vector<std::size_t> initial, changing, others;
  for (const std::size_t i : chosen.panels)
    (panels_[i].initial ? initial : largest_change(panels_[i]) ? changing : others).push_back(i);
  if (!initial.empty()) return refine_in_batch(initial, {});
  if (!changing.empty()) return split_at_changes(changing);
  std::vector<std::size_t> all;
  std::ranges::set_union(others, beside(chosen.jumps), std::back_inserter(all));
  refine_in_batch(all, chosen.jumps);
}

std::vector<std::size_t> Quadrature::too_wide() const {
  std::vector<std::size_t> wide;
  for (std::size_t i = 0; i < panels_.size(); ++i)
    if (!panels_[i].alternating && goal_.too_wide(panels_[i].nodes.front().at, panels_[i].nodes.back().at))
      wide.push_back(i);
  return wide;
}

const QuadratureResult& Quadrature::refine(const QuadratureGoal& goal) {
  goal_ = goal;
  if (result_.status == QuadratureStatus::invalid) return result_;
  result_.status = QuadratureStatus::converged;
  if (panels_.empty()) sample_initial_panels();
  for (auto wide = too_wide(); !wide.empty(); wide = too_wide()) refine_in_batch(wide, {});
  sum();
  while (result_.status == QuadratureStatus::converged && severity(result_.error) > 1) {
    if (result_.samples >= max_samples_) {
      result_.status = QuadratureStatus::not_converged;
      break;
    }
    refine_largest();
    find_alternating_ranges();
    sum();
  }
  for (std::size_t k = 0; k < OBSERVABLES; ++k)
    if (result_.status == QuadratureStatus::converged && goal_.rtol[k] > 0 && result_.error[k] > asked(k))
      result_.status = QuadratureStatus::not_converged;
  list_jumps();
  return result_;
}

const QuadratureResult& Quadrature::interrupted() {
  sum();
  list_jumps();
  result_.status = QuadratureStatus::not_converged;
  return result_;
}

void Quadrature::list_jumps() {
  result_.jumps.clear();
  for (const LabelChange& jump : jumps_)
    result_.jumps.push_back(jump.left.at + (jump.right.at - jump.left.at) / 2);
  std::sort(result_.jumps.begin(), result_.jumps.end());
}

}  // namespace bristle
