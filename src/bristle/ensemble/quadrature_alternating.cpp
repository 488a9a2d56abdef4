// Ranges of a quadrature in which the labels alternate at every scale.
#include "bristle/ensemble/quadrature.hpp"

#include <algorithm>
#include <cmath>

namespace bristle {
namespace {

// Largest number of label changes in a sensitive range whose labels do not alternate: one interval of another
// label has two changes, and one at the end of the quadrature has one.
constexpr std::size_t kMostChanges = 3;
// An alternating panel begins with at least this number of intervals.
constexpr double kLeastIntervals = 32;

}  // namespace

bool Quadrature::alternates() const { return std::ranges::any_of(panels_, &Panel::alternating); }

// Integrates by the trapezoidal rule. The nodes are equidistant up to rounding.
void Quadrature::evaluate_alternating(Panel& panel) {
  Values integral{}, variance{};
  for (std::size_t i = 1; i < panel.nodes.size(); ++i) {
    const double step = panel.nodes[i].at - panel.nodes[i - 1].at;
    for (std::size_t k = 0; k < OBSERVABLES; ++k) {
      const double left = panel.nodes[i - 1].sample.value[k], right = panel.nodes[i].sample.value[k];
      integral[k] += step * (left + right) / 2;
      variance[k] += step * step * (right - left) * (right - left) / 2;
    }
  }
  panel.integral = integral;
  for (std::size_t k = 0; k < OBSERVABLES; ++k) panel.error[k] = std::sqrt(variance[k]);
}

// Returns the sensitive ranges in ascending order. A panel belongs to a range if its label changes or if half
// of its samples are sensitive.
std::vector<Quadrature::SensitiveRange> Quadrature::sensitive_ranges() const {
  std::vector<SensitiveRange> parts;
  for (const LabelChange& jump : jumps_) parts.push_back({jump.left.at, jump.right.at, 1});
  for (const Panel& panel : panels_) {
    std::size_t changes = 0;
    for (std::size_t i = 1; i < panel.nodes.size(); ++i)
      changes += panel.nodes[i - 1].sample.label != panel.nodes[i].sample.label;
    const auto sensitive =
        std::ranges::count_if(panel.nodes, [](const Node& n) { return n.sample.sensitive; });
    if (changes > 0 || 2 * std::size_t(sensitive) >= panel.nodes.size())
      parts.push_back({panel.nodes.front().at, panel.nodes.back().at, changes, panel.alternating});
  }
  std::ranges::sort(parts, {}, &SensitiveRange::from);
  std::vector<SensitiveRange> ranges;
  for (const SensitiveRange& part : parts)
    if (ranges.empty() || ranges.back().to < part.from) ranges.push_back(part);
    else {
      ranges.back().to = part.to;
      ranges.back().changes += part.changes;
      ranges.back().alternating = false;
    }
  return ranges;
}

// Returns the places in this range at which halving of the initial panels arrives at the same time, and the
// ends of the range.
std::vector<double> Quadrature::equidistant(const SensitiveRange& range) const {
  std::vector<double> at;
  for (std::size_t panel = 0; panel + 1 < edges_.size(); ++panel) {
    std::vector<double> nodes = initial_nodes(panel);
    while ((range.to - range.from) / (nodes[1] - nodes[0]) < kLeastIntervals) {
      std::vector<double> finer;
      for (std::size_t i = 1; i < nodes.size(); ++i)
        finer.insert(finer.end(), {nodes[i - 1], nodes[i - 1] + (nodes[i] - nodes[i - 1]) / 2});
      finer.push_back(nodes.back());
      nodes = std::move(finer);
    }
    for (const double x : nodes)
      if (range.from <= x && x <= range.to && (at.empty() || at.back() < x)) at.push_back(x);
  }
  // An end may lie between two of these places.
  if (at.empty() || at.front() > range.from) at.insert(at.begin(), range.from);
  if (at.back() < range.to) at.push_back(range.to);
  return at;
}

// Replaces the panels and jumps of this range by one alternating panel. Their samples are kept.
void Quadrature::make_alternating(const SensitiveRange& range) {
  const auto inside = [&](const Node& left) { return range.from <= left.at && left.at < range.to; };
  for (const LabelChange& jump : jumps_)
    if (inside(jump.left))
      for (const Node* node : {&jump.left, &jump.right}) kept_[node->at] = node->sample;
  for (const Panel& panel : panels_)
    if (inside(panel.nodes.front()))
      for (const Node& node : panel.nodes) kept_[node.at] = node.sample;
  std::vector<Node> nodes = evaluate(equidistant(range));
  std::erase_if(jumps_, [&](const LabelChange& jump) { return inside(jump.left); });
  std::erase_if(panels_, [&](const Panel& panel) { return inside(panel.nodes.front()); });
  panels_.push_back({.nodes = std::move(nodes), .alternating = true});
  evaluate_panel(panels_.back());
  sort_panels();
}

void Quadrature::find_alternating_ranges() {
  for (const SensitiveRange& range : sensitive_ranges())
    if (range.changes > kMostChanges && !range.alternating) make_alternating(range);
}

}  // namespace bristle
