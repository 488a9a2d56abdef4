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
  std::vector<double> objectives;  // to be minimised
  double violation = 0;            // of constraints; 0: none, infinite: the objectives have no value
  bool is_met = false;             // the only objective is a target, and the value meets it within its error
};

// Whether a is better than b: less violation, or else no objective worse and at least one better (K. Deb et
// al., IEEE Trans. Evol. Comput. 6(2), 2002).
bool better(const Score& a, const Score& b);

// Computes trials, in any number at once. The searches never ask for more than their budget.
using Evaluate = std::function<std::vector<Score>(const std::vector<Point>&)>;

// The trials without violation than which no other is better, in the order of their first objective.
std::vector<std::size_t> front_of(const std::vector<Score>& scores);

// Approaches the front of several objectives with the genetic algorithm NSGA-II (as above).
void search_front(std::size_t dimensions, std::size_t budget, std::uint64_t seed, const Evaluate& evaluate);

// Minimises one objective: half of the budget is a Sobol sequence, and each of its trials that is a minimum
// among its neighbours starts a local search by Subplex (T. H. Rowan, 1990; NLopt), which needs no
// derivatives. Where the objective is the distance from a target, a local search ends at a trial that meets
// it. The search then begins with a quarter of the budget, and goes on with half and all of it as long as no
// trial meets the target. Returns the trials at which the local searches ended, without those closer than 1 %
// of the cube's edge to a better one. The first is the best.
std::vector<std::size_t> search_minima(std::size_t dimensions, std::size_t budget, std::uint64_t seed,
                                       const Evaluate& evaluate, bool target = false);

}  // namespace bristle::design
