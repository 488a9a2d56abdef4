#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

// The search of the unit cube. It knows nothing of bristles: a trial is a point of the cube and its score.
namespace bristle::design {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Point = std::vector<double>;

struct Score {
  double objective;      // value to be minimised
  double violation = 0;  // violation of constraints; 0: none, infinite: the objective has no value
  bool is_met = false;   // the objective is a target, met within the error of its value
};

// Returns true if a is better than b: less violation, or as much violation and a smaller objective (K. Deb,
// Comput. Methods Appl. Mech. Eng. 186, 2000).
bool better(const Score& a, const Score& b);

// Computes any number of trials at once. The search never asks for more than its budget.
using Evaluate = std::function<std::vector<Score>(const std::vector<Point>&)>;

// Returns the budgets of the searches that the search with this budget continues, in ascending order: a half
// of it, a quarter, ..., and the budget itself. So a search with twice the budget begins with the trials of
// this one, and finds nothing worse.
std::vector<std::size_t> stages(std::size_t budget);

// Minimises the objective. Half of the budget is a Sobol sequence; each of its trials that is a minimum among
// its neighbours starts a local search by Subplex (T. H. Rowan, 1990; NLopt), which needs no derivatives. The
// search continues the search with half its budget, so that twice the budget never gives a worse minimum.
// target: the objective is the distance from a target; a local search then ends at a trial that meets the
// target, and the whole search ends with a quarter or a half of its budget if a trial meets the target by
// then. Returns the trials at which the local searches ended, best first, without trials closer than 1 % of
// the cube's edge to a better one.
std::vector<std::size_t> search_minima(std::size_t dimensions, std::size_t budget, std::uint64_t seed,
                                       const Evaluate& evaluate, bool target = false);

}  // namespace bristle::design
