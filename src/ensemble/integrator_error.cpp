#include "ensemble/integrator_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace bristle {
namespace {

constexpr double kTighter = 4;         // ratio of the tolerances
constexpr long kMoreEvaluations = 10;  // allowed for them
// Number of repeated passages of each class, all if there are fewer: of those that came near the pole, of
// those that point against the motion, to within kHeadOn, and of the others.
constexpr std::array<std::size_t, 3> kClasses = {12, 6, 6};

std::size_t class_of(const Passage& p) {
  if (p.implicit || p.reflections > 0 || p.outcome == Outcome::pinned) return 0;
  return std::abs(from_head_on(p.theta_0)) < kHeadOn ? 1 : 2;
}

// Systematic sampling: passages at equal distances of the cumulative weight. Their weights have the same sum.
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

// All passages if there are no more than the sample of a mean over many has.
std::vector<WeightedPassage> chosen_of(const std::vector<WeightedPassage>& passages, std::size_t effort) {
  if (passages.size() <= effort * std::accumulate(kClasses.begin(), kClasses.end(), std::size_t(0))) return passages;
  std::array<std::vector<WeightedPassage>, kClasses.size()> classes;
  for (const WeightedPassage& one : passages) classes[class_of(*one.passage)].push_back(one);
  std::vector<WeightedPassage> out;
  for (std::size_t i = 0; i < classes.size(); ++i)
    for (const WeightedPassage& one : sample(classes[i], effort * kClasses[i])) out.push_back(one);
  return out;
}

}  // namespace

ObservableArray integrator_error(const std::vector<WeightedPassage>& passages, const Parameters& parameters,
                                 const std::function<PassageTask(const Passage&)>& task,
                                 const PassageRunner& run, std::size_t effort, long& count) {
  const std::vector<WeightedPassage> chosen = chosen_of(passages, effort);
  std::vector<PassageTask> tasks;
  for (const WeightedPassage& one : chosen) {
    tasks.push_back(task(*one.passage));
    IntegratorOptions& options = tasks.back().integrator;
    options.rtol /= kTighter;
    options.atol /= kTighter;
    options.max_evaluations *= kMoreEvaluations;
  }
  const std::vector<Passage> exact = run(tasks);
  count += long(exact.size());

  ObservableArray difference{}, squares{};
  double most_impact_weight = 0;  // of a repeated passage with impacts
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
    error[k] = kTighter / (kTighter - 1) * std::sqrt(difference[k] * difference[k] + squares[k]);
  // A number of impacts changes by whole ones, so that few repeated passages often show no change.
  error[IMPACT_COUNT] = std::max(error[IMPACT_COUNT], most_impact_weight);
  return error;
}

}  // namespace bristle
