#include "design/search.hpp"

#include "model/elementary.hpp"
#include "util/random.hpp"
#include "util/sobol.hpp"

#include <nlopt.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace bristle::design {
namespace {

bool dominates(const std::vector<double>& a, const std::vector<double>& b) {
  bool less = false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] > b[i]) return false;
    less = less || a[i] < b[i];
  }
  return less;
}

// Uniform random numbers in (0, 1).
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
    const auto value = [o](const Individual* one) { return one->score.objectives[o]; };
    std::ranges::stable_sort(order, {}, value);
    const double range = value(order.back()) - value(order.front());
    order.front()->crowding = order.back()->crowding = kInfinity;
    for (std::size_t i = 1; i + 1 < order.size(); ++i)
      if (range > 0 && std::isfinite(range))
        order[i]->crowding += (value(order[i + 1]) - value(order[i - 1])) / range;
  }
}

// Ranks the individuals by fronts: 0 for those than which none is better, 1 for those that remain, ...
void rank(std::vector<Individual>& all) {
  std::vector<Individual*> rest;
  for (Individual& one : all) {
    one.crowding = 0;
    rest.push_back(&one);
  }
  for (std::size_t rank = 0; !rest.empty(); ++rank) {
    std::vector<Individual*> front, behind;
    for (Individual* one : rest) {
      const bool beaten =
          std::ranges::any_of(rest, [&](const Individual* other) { return better(other->score, one->score); });
      (beaten ? behind : front).push_back(one);
    }
    for (Individual* one : front) one->rank = rank;
    set_crowding(front);
    rest = behind;
  }
}

constexpr double kCrossoverIndex = 15, kMutationIndex = 20, kCrossoverShare = 0.9;

// Simulated binary crossover and polynomial mutation (K. Deb, R. B. Agrawal, Complex Syst. 9, 1995).
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
      child[i] += v < 0.5 ? pow(2 * v, 1 / (kMutationIndex + 1)) - 1 : 1 - pow(2 * (1 - v), 1 / (kMutationIndex + 1));
    child[i] = std::clamp(child[i], 0.0, 1.0);
  }
  return child;
}

double square_of_distance(const Point& a, const Point& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

// The trials from which the way to the nearest better one leads past a worse one: within the ball around the
// middle between both lies another trial, which is not better. The best first.
std::vector<std::size_t> local_minima(const std::vector<Point>& points, const std::vector<Score>& scores) {
  std::vector<std::size_t> minima;
  for (std::size_t i = 0; i < points.size(); ++i) {
    double nearest = kInfinity;
    Point middle(points[i].size());
    for (std::size_t j = 0; j < points.size(); ++j)
      if (const double distance = square_of_distance(points[i], points[j]);
          distance < nearest && better(scores[j], scores[i])) {
        nearest = distance;
        for (std::size_t d = 0; d < middle.size(); ++d) middle[d] = (points[i][d] + points[j][d]) / 2;
      }
    bool between = nearest == kInfinity;  // none is better
    for (std::size_t j = 0; j < points.size() && !between; ++j)
      between = j != i && !better(scores[j], scores[i]) && square_of_distance(points[j], middle) < nearest / 4;
    if (between) minima.push_back(i);
  }
  std::ranges::stable_sort(minima, [&](std::size_t a, std::size_t b) { return better(scores[a], scores[b]); });
  return minima;
}

// Subplex from one start, which asks for one trial at a time. NLopt calls for values, whereas trials of several
// searches are computed together; so each trial repeats the search from its start with the values it knows, up to
// the first that it does not know.
class LocalSearch {
 public:
  LocalSearch(Point start, double value, double step) : start_(std::move(start)), step_(step) { add(start_, value); }
  void add(const Point& point, double value) { known_[point] = value; }
  void end() { ended_ = true; }

  // The trial it needs next; none once it has ended.
  std::optional<Point> next() {
    unknown_.reset();
    if (ended_) return {};
    nlopt::opt search(nlopt::LN_SBPLX, unsigned(start_.size()));
    search.set_min_objective(
        [](const Point& x, Point&, void* data) {
          auto& self = *static_cast<LocalSearch*>(data);
          const auto known = self.known_.find(x);
          if (known != self.known_.end()) return known->second;
          self.unknown_ = x;
          throw nlopt::forced_stop();
        },
        this);
    search.set_lower_bounds(0);
    search.set_upper_bounds(1);
    search.set_initial_step(step_);
    search.set_xtol_abs(1e-5);
    Point x = start_;
    double least = 0;
    try {
      search.optimize(x, least);
    } catch (const nlopt::roundoff_limited&) {  // it has ended
    } catch (const nlopt::forced_stop&) {
    }
    return unknown_;
  }

 private:
  Point start_;
  double step_;
  bool ended_ = false;
  std::map<Point, double> known_;
  std::optional<Point> unknown_;
};

}  // namespace

bool better(const Score& a, const Score& b) {
  if (a.violation != b.violation) return a.violation < b.violation;
  return std::isfinite(a.violation) && dominates(a.objectives, b.objectives);
}

std::vector<std::size_t> front_of(const std::vector<Score>& scores) {
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < scores.size(); ++i)
    if (scores[i].violation == 0 && std::ranges::none_of(scores, [&](const Score& s) { return better(s, scores[i]); }))
      front.push_back(i);
  std::ranges::stable_sort(front, {}, [&](std::size_t i) { return scores[i].objectives.front(); });
  return front;
}

void search_front(std::size_t dimensions, std::size_t budget, std::uint64_t seed, const Evaluate& evaluate) {
  const std::size_t size = std::min(budget, std::clamp<std::size_t>(budget / 10, 8, 64));
  Random random(seed);
  std::vector<Individual> population;
  const auto add = [&](const std::vector<Point>& points) {
    const std::vector<Score> scores = evaluate(points);
    for (std::size_t i = 0; i < points.size(); ++i) population.push_back({points[i], scores[i]});
    rank(population);
    std::ranges::stable_sort(population, preferred);
    population.resize(std::min(population.size(), size));
    budget -= points.size();
  };
  add(sobol_points(size, dimensions, seed));
  const auto winner = [&]() -> const Point& {
    const Individual &a = population[random.below(population.size())], &b = population[random.below(population.size())];
    return preferred(a, b) ? a.point : b.point;
  };
  while (budget > 0) {
    std::vector<Point> children;
    while (children.size() < std::min(size, budget)) {
      Point child;
      // A child that is its parent again would be a trial for nothing.
      for (int attempt = 0; attempt < 10; ++attempt) {
        const Point &a = winner(), &b = winner();
        child = child_of(a, b, random);
        if (child != a) break;
      }
      children.push_back(child);
    }
    add(children);
  }
}

std::vector<std::size_t> search_minima(std::size_t dimensions, std::size_t budget, std::uint64_t seed,
                                       const Evaluate& evaluate) {
  std::vector<Point> points = sobol_points((budget + 1) / 2, dimensions, seed);
  std::vector<Score> scores = evaluate(points);
  double worst = 0;  // of the trials without violation: those with one are worse
  for (const Score& score : scores)
    if (score.violation == 0) worst = std::max(worst, score.objectives.front());
  const auto value = [&](const Score& score) {
    if (score.violation == 0) return score.objectives.front();
    return std::isfinite(score.violation) ? worst + (1 + std::abs(worst)) * (1 + score.violation) : HUGE_VAL;
  };

  std::vector<std::size_t> starts = local_minima(points, scores);
  std::size_t rest = budget - points.size();
  const std::size_t least = 10 * (dimensions + 1);  // trials of a local search
  starts.resize(std::min(starts.size(), std::max<std::size_t>(1, rest / least)));
  const double edge = 1 / pow(double(points.size()), 1 / double(dimensions));
  std::vector<LocalSearch> searches;
  for (const std::size_t start : starts) {
    searches.emplace_back(points[start], value(scores[start]), std::min(edge, 0.25) / 2);
    if (scores[start].is_met) searches.back().end();
  }
  std::vector<std::size_t> ends = starts;
  while (rest > 0) {
    std::vector<std::size_t> asking;
    std::vector<Point> asked;
    for (std::size_t k = 0; k < searches.size() && asked.size() < rest; ++k)
      if (const auto next = searches[k].next()) {
        asking.push_back(k);
        asked.push_back(*next);
      }
    if (asked.empty()) break;
    const std::vector<Score> found = evaluate(asked);
    for (std::size_t i = 0; i < asked.size(); ++i) {
      LocalSearch& search = searches[asking[i]];
      search.add(asked[i], value(found[i]));
      if (found[i].is_met) search.end();
      points.push_back(asked[i]);
      scores.push_back(found[i]);
      if (std::size_t& end = ends[asking[i]]; better(found[i], scores[end])) end = scores.size() - 1;
    }
    rest -= asked.size();
  }
  std::ranges::stable_sort(ends, [&](std::size_t a, std::size_t b) { return better(scores[a], scores[b]); });
  std::vector<std::size_t> distinct;
  for (const std::size_t end : ends)
    if (std::ranges::none_of(distinct, [&](std::size_t other) {
          return square_of_distance(points[end], points[other]) < 1e-4 * double(dimensions);
        }))
      distinct.push_back(end);
  return distinct;
}

}  // namespace bristle::design
