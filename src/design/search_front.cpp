#include "bristle/ensemble/sobol.hpp"
#include "bristle/model/elementary.hpp"
#include "bristle/random.hpp"
#include "design/search.hpp"

#include <algorithm>
#include <cmath>

namespace bristle::design {
namespace {

// One in this many trials of a front comes from the Sobol sequence. Between two jumps of a brush lie small
// regions of good trials, which children of trials elsewhere do not reach.
constexpr std::size_t kSampledPart = 4;

// Draws uniform random numbers in (0, 1).
class Random {
 public:
  explicit Random(std::uint64_t seed) : seed_(split_mix(seed)) {}
  double operator()() { return (double(split_mix(seed_ + kSplitMixStep * ++count_) >> 12) + 0.5) * 0x1p-52; }
  std::size_t below(std::size_t n) { return std::size_t((*this)() * double(n)); }

 private:
  std::uint64_t seed_, count_ = 0;
};

struct Individual {
  Point point;
  Score score;
  std::size_t rank = 0;
  double crowding = 0;  // distance between its neighbours on the front
};

bool preferred(const Individual& a, const Individual& b) {
  return a.rank != b.rank ? a.rank < b.rank : a.crowding > b.crowding;
}

void set_crowding(const std::vector<Individual*>& front) {
  for (std::size_t o = 0; o < front.front()->score.objectives.size(); ++o) {
    std::vector<Individual*> order = front;
    const auto value = [o](const Individual* individual) { return individual->score.objectives[o]; };
    std::ranges::stable_sort(order, {}, value);
    const double range = value(order.back()) - value(order.front());
    order.front()->crowding = order.back()->crowding = kInfinity;
    for (std::size_t i = 1; i + 1 < order.size(); ++i)
      if (range > 0 && std::isfinite(range))
        order[i]->crowding += (value(order[i + 1]) - value(order[i - 1])) / range;
  }
}

// Ranks the individuals by fronts: 0 if no individual is better, 1 if none of the remaining ones is better,
// ...
void rank(std::vector<Individual>& all) {
  std::vector<Individual*> rest;
  for (Individual& individual : all) {
    individual.crowding = 0;
    rest.push_back(&individual);
  }
  for (std::size_t rank = 0; !rest.empty(); ++rank) {
    std::vector<Individual*> front, behind;
    for (Individual* individual : rest) {
      const bool beaten = std::ranges::any_of(
          rest, [&](const Individual* other) { return better(other->score, individual->score); });
      (beaten ? behind : front).push_back(individual);
    }
    for (Individual* individual : front) individual->rank = rank;
    set_crowding(front);
    rest = behind;
  }
}

constexpr double kCrossoverIndex = 15, kMutationIndex = 20, kCrossoverShare = 0.9;

// Creates a child by simulated binary crossover and polynomial mutation (K. Deb, R. B. Agrawal, Complex Syst.
// 9, 1995).
Point child_of(const Point& a, const Point& b, Random& random) {
  Point child = a;
  const bool crossed = random() < kCrossoverShare;
  for (std::size_t i = 0; i < child.size(); ++i) {
    const double u = random(), side = random(), v = random(), mutated = random();
    if (crossed && side < 0.5) {
      const double spread = pow(u < 0.5 ? 2 * u : 1 / (2 * (1 - u)), 1 / (kCrossoverIndex + 1));
      child[i] = ((1 + spread) * a[i] + (1 - spread) * b[i]) / 2;
    }
    if (mutated < 1.0 / double(child.size()))
      child[i] +=
          v < 0.5 ? pow(2 * v, 1 / (kMutationIndex + 1)) - 1 : 1 - pow(2 * (1 - v), 1 / (kMutationIndex + 1));
    child[i] = std::clamp(child[i], 0.0, 1.0);
  }
  return child;
}

}  // namespace

void search_front(std::size_t dimensions, std::size_t budget, std::uint64_t seed, const Evaluate& evaluate) {
  Random random(seed);
  std::vector<Individual> all, population;
  std::size_t sampled = 0;  // points of the Sobol sequence
  const auto keep_best = [&](std::size_t size) {
    rank(population);
    std::ranges::stable_sort(population, preferred);
    population.resize(std::min(population.size(), size));
  };
  const auto add = [&](const std::vector<Point>& points) {
    const std::vector<Score> scores = evaluate(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      all.push_back({points[i], scores[i]});
      population.push_back(all.back());
    }
  };
  const auto winner = [&]() -> const Point& {
    const Individual &a = population[random.below(population.size())],
                     &b = population[random.below(population.size())];
    return preferred(a, b) ? a.point : b.point;
  };
  const auto child = [&] {
    Point out;
    // A child that equals its parent would be a wasted trial.
    for (int attempt = 0; attempt < 10; ++attempt) {
      const Point &a = winner(), &b = winner();
      out = child_of(a, b, random);
      if (out != a) break;
    }
    return out;
  };
  for (const std::size_t trials : stages(budget)) {
    const std::size_t size = std::min(trials, std::clamp<std::size_t>(trials / 10, 8, 64));
    const std::size_t samples = std::max(size, trials / kSampledPart);
    const std::vector<Point> sample = sobol_points(samples, dimensions, seed);
    population = all;
    add({sample.begin() + std::ptrdiff_t(sampled), sample.end()});
    sampled = samples;
    keep_best(size);
    while (all.size() < trials) {
      std::vector<Point> children;
      while (children.size() < std::min(size, trials - all.size())) children.push_back(child());
      add(children);
      keep_best(size);
    }
  }
}

}  // namespace bristle::design
