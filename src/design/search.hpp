#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

// Searches of the unit cube. They know nothing of bristles: a trial is a point of the cube and its score.
namespace bristle::design {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Point = std::vector<double>;

struct Score {
  std::vector<double> objectives;  // values to be minimised
  double violation = 0;  // violation of constraints; 0: none, infinite: the objectives have no value
  bool is_met = false;   // the only objective is a target, met within the error of its value
};

// Returns true if a is better than b: less violation, or as much violation with no objective worse and at
// least one better (K. Deb et al., IEEE Trans. Evol. Comput. 6(2), 2002).
bool better(const Score& a, const Score& b);

// Computes any number of trials at once. The searches never ask for more than their budget.
using Evaluate = std::function<std::vector<Score>(const std::vector<Point>&)>;

// Returns the trials without violation than which no other trial is better, in the order of their first
// objective.
std::vector<std::size_t> front_of(const std::vector<Score>& scores);

// Returns the budgets of the searches that the search with this budget continues, in ascending order: a half
// of it, a quarter, ..., and the budget itself. So a search with twice the budget begins with the trials of
// this one, and finds nothing worse.
std::vector<std::size_t> stages(std::size_t budget);

// Approaches the front of several objectives with the genetic algorithm NSGA-II (K. Deb et al., see
// better()). The search continues the search with half its budget with a larger population, so that twice the
// budget never gives a worse front.
void search_front(std::size_t dimensions, std::size_t budget, std::uint64_t seed, const Evaluate& evaluate);

// Minimises one objective. Half of the budget is a Sobol sequence; each of its trials that is a minimum among
// its neighbours starts a local search by Subplex (T. H. Rowan, 1990; NLopt), which needs no derivatives. The
// search continues the search with half its budget, so that twice the budget never gives a worse minimum.
// target: the objective is the distance from a target; a local search then ends at a trial that meets the
// target, and the whole search ends with a quarter or a half of its budget if a trial meets the target by
// then. Returns the trials at which the local searches ended, best first, without trials closer than 1 % of
// the cube's edge to a better one.
std::vector<std::size_t> search_minima(std::size_t dimensions, std::size_t budget, std::uint64_t seed,
                                       const Evaluate& evaluate, bool target = false);

}  // namespace bristle::design
