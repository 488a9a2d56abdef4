#pragma once

#include "interface/quadrature.hpp"

#include <algorithm>
#include <cmath>

namespace bristle {

// Jumps closer than this are not told apart.
constexpr double kSmallestPanel = 1e-7;
// Part of the tolerance that the unknown place of one jump may use up.
constexpr double kJumpShare = 0.2;

template <std::size_t N>
typename Quadrature<N>::Node Quadrature<N>::evaluate(double at) {
  ++result_.samples;
  Node node{at, f_(at)};
  if (!node.sample.valid) result_.status = QuadratureStatus::invalid;
  return node;
}

template <std::size_t N>
typename Quadrature<N>::Panel Quadrature<N>::make_panel(double from, double to) {
  const KronrodRule& rule = kronrod_rule(to - from);
  const double half = (to - from) / 2, middle = from + half;
  Panel panel{from, to, {}, {}, {}};
  std::array<double, N> gauss{};
  for (std::size_t i = 0; i < rule.node.size(); ++i) {
    panel.nodes.push_back(evaluate(middle + half * rule.node[i]));
    const auto& value = panel.nodes.back().sample.value;
    for (std::size_t k = 0; k < N; ++k) {
      panel.integral[k] += half * rule.weight[i] * value[k];
      gauss[k] += half * rule.gauss_weight[i] * value[k];
    }
  }
  for (std::size_t k = 0; k < N; ++k) {
    const auto value = [&](std::size_t i) { return panel.nodes[i].sample.value[k]; };
    const double mean = panel.integral[k] / (to - from);
    double spread = 0, misfit = 0;
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      double interpolated = 0;
      for (std::size_t j = 0; j < rule.node.size(); ++j) interpolated += rule.interpolation[i][j] * value(j);
      const double deviation = value(i) - mean, difference = value(i) - interpolated;
      spread += half * rule.weight[i] * deviation * deviation;
      misfit += half * rule.weight[i] * difference * difference;
    }
    const double roughness = spread > 0 ? std::min(1.0, std::sqrt(misfit / spread)) : 0;
    panel.error[k] =
        std::max(std::abs(panel.integral[k] - gauss[k]), roughness * std::sqrt(misfit * (to - from)));
  }
  return panel;
}

// Narrows the change down until what its unknown place can alter is small against the tolerance, and
// makes the place a border of the panels about it.
template <std::size_t N>
void Quadrature<N>::locate(Change change) {
  auto& [left, right] = change;
  // At least one step: a jump narrowed before is passed again when it has become the worst.
  do {
    if (right.at - left.at <= kSmallestPanel) break;
    const Node middle = evaluate(left.at + (right.at - left.at) / 2);
    (middle.sample.label == left.sample.label ? left : right) = middle;
  } while (result_.status != QuadratureStatus::invalid && severity(uncertainty(change)) > kJumpShare);
  jumps_.push_back(change);
  const double cut = place(change);
  const auto ends_after = [](double at, const Panel& p) { return at < p.to; };
  const auto first = std::upper_bound(panels_.begin(), panels_.end(), left.at, ends_after);
  auto last = std::upper_bound(first, panels_.end(), right.at, ends_after);
  if (last == panels_.end()) --last;
  const double from = first->from, to = last->to;
  *first = make_panel(from, cut);
  const auto after = panels_.erase(first + 1, last + 1);
  panels_.insert(after, make_panel(cut, to));
}

template <std::size_t N>
std::array<double, N> Quadrature<N>::uncertainty(const Change& change) {
  const Node &left = change.first, &right = change.second;
  std::array<double, N> error;
  for (std::size_t k = 0; k < N; ++k)
    error[k] = std::abs(left.sample.value[k] - right.sample.value[k]) * (right.at - left.at) / 2;
  return error;
}

// Neighbouring nodes, ends of the range included, whose labels differ with no jump located between.
template <std::size_t N>
void Quadrature<N>::find_changes() {
  changes_.clear();
  const Node* left = &ends_.front();
  const auto visit = [&](const Node& right) {
    const auto between = [&](const Change& jump) {
      return left->at <= place(jump) && place(jump) <= right.at;
    };
    if (left->sample.label != right.sample.label && std::none_of(jumps_.begin(), jumps_.end(), between))
      changes_.push_back({*left, right});
    left = &right;
  };
  for (const Panel& panel : panels_)
    for (const Node& node : panel.nodes) visit(node);
  visit(ends_.back());
}

template <std::size_t N>
void Quadrature<N>::sum() {
  find_changes();
  result_.integral = {};
  std::array<double, N> squares{};
  const auto add_error = [&squares](const std::array<double, N>& error) {
    for (std::size_t k = 0; k < N; ++k) squares[k] += error[k] * error[k];
  };
  for (const Panel& panel : panels_) {
    for (std::size_t k = 0; k < N; ++k) result_.integral[k] += panel.integral[k];
    add_error(panel.error);
  }
  for (const Change& jump : jumps_) add_error(uncertainty(jump));
  for (const Change& change : changes_) add_error(uncertainty(change));
  for (std::size_t k = 0; k < N; ++k) result_.error[k] = std::sqrt(squares[k]);
}

template <std::size_t N>
double Quadrature<N>::allowed(std::size_t k) const {
  const double of_value = options_.rtol[k] * std::abs(result_.integral[options_.scale[k]]);
  if (!options_.decide_about) return of_value;
  return std::max(of_value, std::abs(result_.integral[k] - *options_.decide_about) / 4);
}

// The largest ratio of an error to what is allowed in all.
template <std::size_t N>
double Quadrature<N>::severity(const std::array<double, N>& error) const {
  double worst = 0;
  for (std::size_t k = 0; k < N; ++k) {
    if (options_.rtol[k] == 0 || error[k] == 0) continue;
    worst = std::max(worst, error[k] / allowed(k));
  }
  return worst;
}

// Of these changes the one that contributes more than most to the components that lack; updates most.
template <std::size_t N>
std::optional<std::size_t> Quadrature<N>::worse(const std::vector<Change>& changes, double& most) const {
  std::optional<std::size_t> worst;
  for (std::size_t i = 0; i < changes.size(); ++i)
    if (const double s = lacking(uncertainty(changes[i])); s > most) {
      most = s;
      worst = i;
    }
  return worst;
}

// Severity in the components whose error is still too large.
template <std::size_t N>
double Quadrature<N>::lacking(std::array<double, N> error) const {
  for (std::size_t k = 0; k < N; ++k)
    if (result_.error[k] <= allowed(k)) error[k] = 0;
  return severity(error);
}

// Narrows the jump or halves the panel that lacks most.
template <std::size_t N>
void Quadrature<N>::refine_worst() {
  double most = -1;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < panels_.size(); ++i)
    if (const double s = lacking(panels_[i].error); s > most) {
      most = s;
      worst = i;
    }
  if (const auto jump = worse(jumps_, most)) {
    const Change again = jumps_[*jump];
    jumps_.erase(jumps_.begin() + std::ptrdiff_t(*jump));
    return locate(again);
  }
  const Panel panel = panels_[worst];
  // A jump in or beside the panel is what its error comes from.
  std::vector<Change> near;
  for (const Change& c : changes_)
    if (c.first.at < panel.to && c.second.at > panel.from) near.push_back(c);
  double noticeable = kJumpShare;
  if (const auto change = worse(near, noticeable)) return locate(near[*change]);
  if (const auto change = worse(changes_, most)) return locate(changes_[*change]);
  const double middle = panel.from + (panel.to - panel.from) / 2;
  panels_[worst] = make_panel(panel.from, middle);
  panels_.insert(panels_.begin() + std::ptrdiff_t(worst) + 1, make_panel(middle, panel.to));
}

template <std::size_t N>
QuadratureResult<N> Quadrature<N>::integrate() {
  const auto& edges = options_.edges;
  ends_ = {evaluate(edges.front()), evaluate(edges.back())};
  for (std::size_t i = 1; i < edges.size(); ++i) panels_.push_back(make_panel(edges[i - 1], edges[i]));
  sum();
  while (result_.status == QuadratureStatus::converged && severity(result_.error) > 1) {
    if (result_.samples >= options_.max_samples) {
      result_.status = QuadratureStatus::not_converged;
      break;
    }
    refine_worst();
    sum();
  }
  for (const Change& jump : jumps_) result_.jumps.push_back(place(jump));
  std::sort(result_.jumps.begin(), result_.jumps.end());
  return result_;
}

}  // namespace bristle
