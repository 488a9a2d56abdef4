#pragma once

#include "ensemble/quadrature.hpp"

#include <algorithm>
#include <cmath>

namespace bristle {

// Jumps closer than this are not resolved.
constexpr double kSmallestPanel = 1e-7;
// Share of the tolerance that the uncertain position of one jump may use.
constexpr double kJumpShare = 0.2;
constexpr std::size_t kMaxNodes = 9;
// Panels whose estimate is small by accident are not refined further, which biases the total error. The
// estimates of rough panels are therefore multiplied by this factor (calibrated in docs/numerics.md).
constexpr double kRoughnessFactor = 2;

template <std::size_t N>
std::vector<typename Quadrature<N>::Node> Quadrature<N>::evaluate(const std::vector<double>& at) {
  const std::vector<Sample<N>> samples = f_(at);
  std::vector<Node> nodes;
  for (std::size_t i = 0; i < at.size(); ++i) {
    nodes.push_back({at[i], samples[i]});
    if (!samples[i].valid) result_.status = QuadratureStatus::invalid;
  }
  result_.samples += long(at.size());
  return nodes;
}

// Samples all initial panels in one batch.
template <std::size_t N>
void Quadrature<N>::sample_initial_panels() {
  constexpr std::size_t steps = kMaxNodes - 1;
  std::vector<double> at;
  for (std::size_t e = 1; e < edges_.size(); ++e)
    for (std::size_t i = 0; i < steps; ++i)
      at.push_back(edges_[e - 1] + (edges_[e] - edges_[e - 1]) * double(i) / steps);
  at.push_back(edges_.back());
  const std::vector<Node> nodes = evaluate(at);
  for (std::size_t first = 0; first + steps < nodes.size(); first += steps)
    panels_.push_back(make_panel({nodes.begin() + first, nodes.begin() + first + kMaxNodes}));
}

// The rule of every stride-th node of the panel.
template <std::size_t N>
typename Quadrature<N>::Values Quadrature<N>::rule(const Panel& panel, std::size_t stride) const {
  const NestedRule& r = nested_rule((panel.nodes.size() - 1) / stride + 1);
  Values integral{};
  for (std::size_t i = 0; i < r.weight.size(); ++i)
    for (std::size_t k = 0; k < N; ++k)
      integral[k] += panel.width() * r.weight[i] * panel.nodes[i * stride].sample.value[k];
  return integral;
}

template <std::size_t N>
void Quadrature<N>::evaluate_panel(Panel& panel) const {
  const std::size_t n = panel.nodes.size();
  const auto value = [&](std::size_t i, std::size_t k) { return panel.nodes[i].sample.value[k]; };
  panel.integral = rule(panel, 1);
  if (n == 2) {
    for (std::size_t k = 0; k < N; ++k)
      panel.error[k] = std::abs(value(1, k) - value(0, k)) * panel.width() / 2;
    return;
  }
  const NestedRule& r = nested_rule(n);
  const Values coarse = rule(panel, 2);
  for (std::size_t k = 0; k < N; ++k) {
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

template <std::size_t N>
typename Quadrature<N>::Panel Quadrature<N>::make_panel(std::vector<Node> nodes) const {
  Panel panel{std::move(nodes), {}, {}};
  evaluate_panel(panel);
  return panel;
}

// Adds a node in the middle between any two nodes; splits the panel if it then has too many.
template <std::size_t N>
void Quadrature<N>::halve_spacing(std::size_t index) {
  const std::vector<Node> old = panels_[index].nodes;
  std::vector<double> at;
  for (std::size_t i = 1; i < old.size(); ++i) at.push_back(old[i - 1].at + (old[i].at - old[i - 1].at) / 2);
  const std::vector<Node> added = evaluate(at);
  std::vector<Node> nodes{old.front()};
  for (std::size_t i = 0; i < added.size(); ++i) {
    nodes.push_back(added[i]);
    nodes.push_back(old[i + 1]);
  }
  std::vector<Panel> panels;
  append_panels(panels, nodes, false);
  replace(index, panels);
}

template <std::size_t N>
void Quadrature<N>::replace(std::size_t index, const std::vector<Panel>& panels) {
  const auto place = panels_.erase(panels_.begin() + std::ptrdiff_t(index));
  panels_.insert(place, panels.begin(), panels.end());
}

template <std::size_t N>
std::optional<typename Quadrature<N>::LabelChange> Quadrature<N>::change_in(const Panel& panel) const {
  std::optional<LabelChange> worst;
  double largest = -1;
  for (std::size_t i = 1; i < panel.nodes.size(); ++i) {
    const LabelChange change{panel.nodes[i - 1], panel.nodes[i]};
    if (change.left.sample.label == change.right.sample.label) continue;
    if (const double s = severity(uncertainty(change)); s > largest) {
      largest = s;
      worst = change;
    }
  }
  return worst;
}

template <std::size_t N>
typename Quadrature<N>::Values Quadrature<N>::uncertainty(const LabelChange& change) {
  Values error;
  for (std::size_t k = 0; k < N; ++k)
    error[k] = std::abs(change.left.sample.value[k] - change.right.sample.value[k]) *
               (change.right.at - change.left.at) / 2;
  return error;
}

// Bisects the change until the error due to its uncertain position is small compared with the tolerance. The
// trails are the nodes to the left and right of the jump, ascending, including those of the change.
template <std::size_t N>
void Quadrature<N>::bisect(LabelChange& change, std::vector<Node>& left_trail,
                           std::vector<Node>& right_trail) {
  left_trail = {change.left};
  right_trail = {change.right};
  // At least one step: a jump is narrowed again if it has the largest error.
  do {
    if (change.right.at - change.left.at <= kSmallestPanel) break;
    const Node middle = evaluate({change.left.at + (change.right.at - change.left.at) / 2}).front();
    if (middle.sample.label == change.left.sample.label) left_trail.push_back(change.left = middle);
    else right_trail.insert(right_trail.begin(), change.right = middle);
  } while (result_.status != QuadratureStatus::invalid && severity(uncertainty(change)) > kJumpShare);
}

// Appends panels for equidistant nodes, each as large as possible, starting from the left or from the right.
template <std::size_t N>
void Quadrature<N>::append_panels(std::vector<Panel>& out, const std::vector<Node>& nodes,
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

// Replaces the panel by panels on both sides of the jump in it.
template <std::size_t N>
void Quadrature<N>::locate_jump(std::size_t index) {
  const std::vector<Node> nodes = panels_[index].nodes;
  LabelChange jump = *change_in(panels_[index]);
  const auto right =
      std::find_if(nodes.begin(), nodes.end(), [&](const Node& n) { return n.at == jump.right.at; });
  std::vector<Node> left_trail, right_trail;
  bisect(jump, left_trail, right_trail);
  std::vector<Panel> panels;
  append_panels(panels, {nodes.begin(), right}, false);
  for (std::size_t i = 1; i < left_trail.size(); ++i)
    panels.push_back(make_panel({left_trail[i - 1], left_trail[i]}));
  for (std::size_t i = 1; i < right_trail.size(); ++i)
    panels.push_back(make_panel({right_trail[i - 1], right_trail[i]}));
  append_panels(panels, {right, nodes.end()}, true);
  jumps_.push_back(jump);
  replace(index, panels);
}

// Narrows a located jump further.
template <std::size_t N>
void Quadrature<N>::narrow_jump(LabelChange& jump) {
  std::vector<Node> left_trail, right_trail;
  bisect(jump, left_trail, right_trail);
  std::vector<Panel> panels;
  for (const auto* trail : {&left_trail, &right_trail})
    for (std::size_t i = 1; i < trail->size(); ++i)
      panels.push_back(make_panel({(*trail)[i - 1], (*trail)[i]}));
  const auto next = std::find_if(panels_.begin(), panels_.end(),
                                 [&](const Panel& p) { return p.nodes.front().at >= jump.right.at; });
  panels_.insert(next, panels.begin(), panels.end());
  std::sort(panels_.begin(), panels_.end(),
            [](const Panel& a, const Panel& b) { return a.nodes.front().at < b.nodes.front().at; });
}

template <std::size_t N>
void Quadrature<N>::sum() {
  result_.integral = {};
  Values squares{};
  const auto add_error = [&squares](const Values& error) {
    for (std::size_t k = 0; k < N; ++k) squares[k] += error[k] * error[k];
  };
  for (const Panel& panel : panels_) {
    for (std::size_t k = 0; k < N; ++k) result_.integral[k] += panel.integral[k];
    add_error(panel.error);
    for (std::size_t i = 1; i < panel.nodes.size(); ++i)
      if (panel.nodes[i - 1].sample.label != panel.nodes[i].sample.label)
        add_error(uncertainty({panel.nodes[i - 1], panel.nodes[i]}));
  }
  for (const LabelChange& jump : jumps_) {
    const double width = jump.right.at - jump.left.at;
    for (std::size_t k = 0; k < N; ++k)
      result_.integral[k] += width * (jump.left.sample.value[k] + jump.right.sample.value[k]) / 2;
    add_error(uncertainty(jump));
  }
  for (std::size_t k = 0; k < N; ++k) result_.error[k] = std::sqrt(squares[k]);
}

template <std::size_t N>
double Quadrature<N>::tolerance(std::size_t k) const {
  const double relative = goal_.rtol[k] * std::abs(result_.integral[goal_.scale[k]]);
  if (!goal_.threshold) return relative;
  return std::max(relative, std::abs(result_.integral[k] - *goal_.threshold) / 4);
}

// The largest ratio of an error to the tolerance of its component.
template <std::size_t N>
double Quadrature<N>::severity(const Values& error) const {
  double worst = 0;
  for (std::size_t k = 0; k < N; ++k) {
    if (goal_.rtol[k] == 0 || error[k] == 0) continue;
    worst = std::max(worst, error[k] / tolerance(k));
  }
  return worst;
}

// Severity in the components whose total error exceeds the tolerance.
template <std::size_t N>
double Quadrature<N>::unmet_severity(Values error) const {
  for (std::size_t k = 0; k < N; ++k)
    if (result_.error[k] <= tolerance(k)) error[k] = 0;
  return severity(error);
}

// Refines the panel, or narrows the jump, with the largest unmet severity.
template <std::size_t N>
void Quadrature<N>::refine_worst() {
  double largest = -1;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < panels_.size(); ++i) {
    double s = unmet_severity(panels_[i].error);
    if (const auto change = change_in(panels_[i])) s = std::max(s, unmet_severity(uncertainty(*change)));
    if (s > largest) {
      largest = s;
      worst = i;
    }
  }
  LabelChange* jump = nullptr;
  for (LabelChange& j : jumps_)
    if (const double s = unmet_severity(uncertainty(j));
        s > largest && j.right.at - j.left.at > kSmallestPanel) {
      largest = s;
      jump = &j;
    }
  if (jump) return narrow_jump(*jump);
  if (change_in(panels_[worst])) return locate_jump(worst);
  halve_spacing(worst);
}

template <std::size_t N>
const QuadratureResult<N>& Quadrature<N>::refine(const QuadratureGoal<N>& goal) {
  goal_ = goal;
  if (result_.status == QuadratureStatus::invalid) return result_;
  result_.status = QuadratureStatus::converged;
  if (panels_.empty()) sample_initial_panels();
  for (std::size_t i = 0; i < panels_.size();)
    if (panels_[i].width() > goal.max_panel_width) halve_spacing(i);
    else ++i;
  sum();
  while (result_.status == QuadratureStatus::converged && severity(result_.error) > 1) {
    if (result_.samples >= max_samples_) {
      result_.status = QuadratureStatus::not_converged;
      break;
    }
    refine_worst();
    sum();
  }
  result_.jumps.clear();
  for (const LabelChange& jump : jumps_)
    result_.jumps.push_back(jump.left.at + (jump.right.at - jump.left.at) / 2);
  std::sort(result_.jumps.begin(), result_.jumps.end());
  return result_;
}

}  // namespace bristle
