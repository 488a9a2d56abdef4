#include "bristle/ensemble/integrator_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace bristle {
namespace {

// Ratios of the original to the tighter tolerance of a repeated passage. A sample of the passages is repeated
// with the first ratio. If there are few passages, all are repeated, once with each ratio: with one or two
// ratios, the original and the repeated passages of a bristle that is about to be pinned, or that the slab
// may never leave, may agree by chance.
constexpr std::array<double, 3> kTighter = {4, 16, 64};
constexpr long kMoreEvaluations = 10;  // factor on max_evaluations for a repeated passage
// Number of repeated passages in each class: bristles that came near the pole, other bristles that point
// against the motion to within kHeadOn, and all others. A class with fewer passages is repeated completely.
constexpr std::array<std::size_t, 3> kClasses = {12, 6, 6};

std::size_t class_of(const Passage& p) {
  if (p.implicit || p.reflections > 0 || p.outcome == Outcome::pinned) return 0;
  return std::abs(from_head_on(p.theta_0)) < kHeadOn ? 1 : 2;
}

// Samples `count` passages at equal distances of the cumulative weight (systematic sampling). The weights of
// the sample have the same sum.
std::vector<WeightedPassage> sample(const std::vector<WeightedPassage>& all, std::size_t count) {
  if (all.size() <= count) return all;
  double total = 0, passed = 0;
  for (const WeightedPassage& one : all) total += one.weight;
  const double step = total / double(count);
  std::vector<WeightedPassage> out;
  for (const WeightedPassage& one : all) {
    const double from = passed;
    passed += one.weight;
    const double hits = std::floor(passed / step + 0.5) - std::floor(from / step + 0.5);
    if (hits > 0) out.push_back({one.passage, hits * step});
  }
  return out;
}

std::vector<WeightedPassage> sample_of_classes(const std::vector<WeightedPassage>& passages,
                                               std::size_t effort) {
  std::array<std::vector<WeightedPassage>, kClasses.size()> classes;
  for (const WeightedPassage& one : passages) classes[class_of(*one.passage)].push_back(one);
  std::vector<WeightedPassage> out;
  for (std::size_t i = 0; i < classes.size(); ++i)
    for (const WeightedPassage& one : sample(classes[i], effort * kClasses[i])) out.push_back(one);
  return out;
}

// Estimates the error of the means by repeating the chosen passages with a tolerance that is `tighter` times
// smaller. Adds the number of repetitions to `count`.
ObservableArray error_by(double tighter, const std::vector<WeightedPassage>& chosen,
                         const Parameters& parameters, const std::function<PassageTask(const Passage&)>& task,
                         const PassageRunner& run, long& count) {
  std::vector<PassageTask> tasks;
  for (const WeightedPassage& one : chosen) {
    tasks.push_back(task(*one.passage));
    IntegratorOptions& options = tasks.back().integrator;
    options.rtol /= tighter;
    options.atol /= tighter;
    options.max_evaluations *= kMoreEvaluations;
  }
  const std::vector<Passage> exact = run(tasks);
  count += long(exact.size());

  ObservableArray difference{}, squares{};
  double most_impact_weight = 0;  // largest weight of a repeated passage with impacts
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const ObservableArray a = observables(*chosen[i].passage, parameters);
    const ObservableArray b = exact[i].complete() ? observables(exact[i], parameters) : ObservableArray{};
    if (a[IMPACT_COUNT] > 0) most_impact_weight = std::max(most_impact_weight, chosen[i].weight);
    for (std::size_t k = 0; k < OBSERVABLES; ++k) {
      const double change = chosen[i].weight * (b[k] - a[k]);
      difference[k] += change;
      squares[k] += change * change;
    }
  }
  ObservableArray error;
  for (std::size_t k = 0; k < OBSERVABLES; ++k)
    error[k] = tighter / (tighter - 1) * std::sqrt(difference[k] * difference[k] + squares[k]);
  // The number of impacts is an integer, so that a few repeated passages often show no change.
  error[IMPACT_COUNT] = std::max(error[IMPACT_COUNT], most_impact_weight);
  return error;
}

}  // namespace

ObservableArray integrator_error(const std::vector<WeightedPassage>& passages, const Parameters& parameters,
                                 const std::function<PassageTask(const Passage&)>& task,
                                 const PassageRunner& run, std::size_t effort, long& count) {
  const auto by = [&](double tighter, const std::vector<WeightedPassage>& chosen) {
    return error_by(tighter, chosen, parameters, task, run, count);
  };
  // All passages are repeated if they are no more than a full sample has.
  const bool all =
      passages.size() <= effort * std::accumulate(kClasses.begin(), kClasses.end(), std::size_t(0));
  if (!all) return by(kTighter[0], sample_of_classes(passages, effort));
  ObservableArray error{};
  for (const double tighter : kTighter) {
    const ObservableArray one = by(tighter, passages);
    for (std::size_t k = 0; k < OBSERVABLES; ++k) error[k] = std::max(error[k], one[k]);
  }
  return error;
}

}  // namespace bristle
