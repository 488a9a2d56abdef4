#include "bristle/ensemble/sobol.hpp"
#include "bristle/model/elementary.hpp"
#include "design/search.hpp"

#include <nlopt.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace bristle::design {
namespace {

double square_of_distance(const Point& a, const Point& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

// Returns the trials that look like separate minima, best first: no trial is better, or between the trial and
// its nearest better one lies a trial that is not better (inside the ball whose diameter joins the two).
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
      between =
          j != i && !better(scores[j], scores[i]) && square_of_distance(points[j], middle) < nearest / 4;
    if (between) minima.push_back(i);
  }
  std::ranges::stable_sort(minima,
                           [&](std::size_t a, std::size_t b) { return better(scores[a], scores[b]); });
  return minima;
}

// Runs Subplex from one start and asks for one trial at a time. NLopt calls for values, whereas trials of
// several searches are computed together; so next() repeats the search from its start with the values that
// are known, up to the first one that is not.
class LocalSearch {
 public:
  LocalSearch(Point start, double value, double step, std::size_t best)
      : best(best), start_(std::move(start)), step_(step) {
    add(start_, value);
  }
  void add(const Point& point, double value) { known_[point] = value; }
  void end() { ended_ = true; }
  bool is_active() const { return !ended_; }

  std::size_t best;       // best trial of this search, in the caller's numbering
  bool given_up = false;  // whether it ended for the sake of a better start

  // Returns the trial that the search needs next; none once the search has ended.
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
    } catch (const nlopt::roundoff_limited&) {  // the search has ended
    } catch (const nlopt::forced_stop&) {
    }
    ended_ = !unknown_;
    return unknown_;
  }

 private:
  Point start_;
  double step_;
  bool ended_ = false;
  std::map<Point, double> known_;
  std::optional<Point> unknown_;
};

// Minimises the objective. Keeps all trials and the local searches.
class MinimumSearch {
 public:
  MinimumSearch(std::size_t dimensions, std::uint64_t seed, const Evaluate& evaluate)
      : dimensions_(dimensions), seed_(seed), evaluate_(evaluate) {}

  bool is_met() const {
    return std::ranges::any_of(scores_, [](const Score& score) { return score.is_met; });
  }

  // Continues until there are `trials` trials: half from the Sobol sequence, half from local searches. Runs
  // at most trials / 2 / of_a_search searches at a time, so that each can use of_a_search trials.
  void run(std::size_t trials, std::size_t of_a_search) {
    const std::vector<Point> sample = sobol_points((trials + 1) / 2, dimensions_, seed_);
    add({sample.begin() + std::ptrdiff_t(sampled_), sample.end()});
    sampled_ = sample.size();
    for (const Score& score : scores_)
      if (score.violation == 0) worst_ = std::max(worst_, score.objective);
    searched_.resize(points_.size(), false);
    start_searches(std::max<std::size_t>(1, trials / 2 / of_a_search));
    while (points_.size() < trials && ask(trials - points_.size())) {
    }
    searched_.resize(points_.size(), true);
  }

  // Returns the trials at which local searches ended, best first, without trials closer than 1 % of the
  // cube's edge to a better one.
  std::vector<std::size_t> distinct_ends() const {
    std::vector<std::size_t> ends, distinct;
    for (const LocalSearch& search : searches_)
      if (!search.given_up) ends.push_back(search.best);
    std::ranges::stable_sort(ends,
                             [&](std::size_t a, std::size_t b) { return better(scores_[a], scores_[b]); });
    for (const std::size_t end : ends)
      if (std::ranges::none_of(distinct, [&](std::size_t other) {
            return square_of_distance(points_[end], points_[other]) < 1e-4 * double(dimensions_);
          }))
        distinct.push_back(end);
    return distinct;
  }

 private:
  void add(const std::vector<Point>& points) {
    for (Score& score : evaluate_(points)) scores_.push_back(std::move(score));
    points_.insert(points_.end(), points.begin(), points.end());
  }

  // Returns the value of trial i that local searches minimise. A trial with a violation is worse than all
  // others.
  double value(std::size_t i) const {
    const Score& score = scores_[i];
    if (score.violation == 0) return score.objective;
    return std::isfinite(score.violation) ? worst_ + (1 + std::abs(worst_)) * (1 + score.violation)
                                          : HUGE_VAL;
  }

  // Gives up the active local search with the worst best trial if this trial is better. Returns false if it
  // is not.
  bool give_up_for(std::size_t trial) {
    LocalSearch* worst = nullptr;
    for (LocalSearch& search : searches_)
      if (search.is_active() && (!worst || better(scores_[worst->best], scores_[search.best])))
        worst = &search;
    if (!worst || !better(scores_[trial], scores_[worst->best])) return false;
    worst->end();
    worst->given_up = true;
    return true;
  }

  // Starts local searches until `most` of them are active, also in place of searches that have found less
  // than where the new ones start.
  void start_searches(std::size_t most) {
    auto active = std::size_t(std::ranges::count_if(searches_, &LocalSearch::is_active));
    const double edge = 1 / pow(double(sampled_), 1 / double(dimensions_));
    for (const std::size_t start : local_minima(points_, scores_)) {
      if (searched_[start]) continue;
      if (active >= most) {
        if (!give_up_for(start)) break;
        --active;
      }
      searched_[start] = true;
      searches_.emplace_back(points_[start], value(start), std::min(edge, 0.25) / 2, start);
      if (scores_[start].is_met) searches_.back().end();
      else ++active;
    }
  }

  // Computes the next trial of each active search, at most `most` trials. Returns false if no search is
  // active.
  bool ask(std::size_t most) {
    std::vector<LocalSearch*> asking;
    std::vector<Point> asked;
    for (LocalSearch& search : searches_)
      if (asked.size() < most)
        if (const auto next = search.next()) {
          asking.push_back(&search);
          asked.push_back(*next);
        }
    if (asked.empty()) return false;
    const std::size_t first = points_.size();
    add(asked);
    for (std::size_t i = 0; i < asked.size(); ++i) {
      LocalSearch& search = *asking[i];
      search.add(asked[i], value(first + i));
      if (scores_[first + i].is_met) search.end();
      if (better(scores_[first + i], scores_[search.best])) search.best = first + i;
    }
    return true;
  }

  std::size_t dimensions_;
  std::uint64_t seed_;
  const Evaluate& evaluate_;
  std::size_t sampled_ = 0;  // points of the Sobol sequence
  std::vector<Point> points_;
  std::vector<Score> scores_;
  std::vector<bool> searched_;  // whether a local search has been at the trial
  std::vector<LocalSearch> searches_;
  double worst_ = 0;  // greatest objective of the trials without violation
};

}  // namespace

std::vector<std::size_t> search_minima(std::size_t dimensions, std::size_t budget, std::uint64_t seed,
                                       const Evaluate& evaluate, bool target) {
  MinimumSearch search(dimensions, seed, evaluate);
  // Trials of a local search that finds its minimum; a target is met in half of them.
  const std::size_t of_a_search = 10 * (dimensions + 1) / (target ? 2 : 1);
  for (const std::size_t trials : stages(budget)) {
    search.run(trials, of_a_search);
    if (target && search.is_met() && trials >= budget / 4) break;
  }
  return search.distinct_ends();
}

}  // namespace bristle::design
