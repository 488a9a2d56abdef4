#include "bristle/ensemble/trace.hpp"

#include "bristle/dynamics/jobs.hpp"
#include "bristle/ensemble/brush_mean.hpp"

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/roots.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace bristle {
namespace {

constexpr int kFirstIntervals = 24;
constexpr double kSmallLoad = 0.1;      // R_n below which the resolution is absolute
constexpr int kSearchSteps = 10;        // maximum steps of the search for a fold or a landing
constexpr long kReservedNodes = 12;     // nodes kept free for the results of the searches
constexpr double kMinFoldDepth = 0.25;  // depth in units of the resolution below which folds are ignored

class Tracer {
 public:
  Tracer(const Setup& setup, const Trace& trace, const PassageRunner& run)
      : setup_(setup), trace_(trace), run_(run) {}

  std::vector<CurveNode> trace() {
    const double top = brush_.first_contact();
    std::vector<double> first;
    for (int i = 0; i <= kFirstIntervals; ++i) first.push_back(top - (top - trace_.to) * i / kFirstIntervals);
    compute(first);
    while (refine()) {
    }
    const auto found = folds();
    run_all(found, [this](const Fold& fold, const PassageRunner& run) { refine_fold(fold, run); });
    run_all(landings(found),
            [this](const Landing& landing, const PassageRunner& run) { refine_landing(landing, run); });
    return nodes_with_branches();
  }

 private:
  // A node at which a path ends, with the nodes before and after it on the path: gaps descend for sign 1 and
  // ascend for sign -1.
  struct Fold {
    double sign, before, at, after;
  };
  // Neighbouring nodes after a fold between which R_n passes `load`, its value at the fold.
  struct Landing {
    double near, far, load;
  };

  template <class Task, class Do>
  void run_all(const std::vector<Task>& tasks, Do what) {
    std::vector<Job> jobs;
    for (const Task& task : tasks)
      jobs.push_back([&task, what](const PassageRunner& run) { what(task, run); });
    run_together(jobs, run_);
  }

  PointResult solve(double z_0, const PassageRunner& run) {
    BrushMean mean(brush_, z_0, run);
    PointResult node = values_of(setup_.parameters, mean.with_integrator_error());
    node.start = brush_.start();
    node.passages = mean.count();
    node.z_0 = z_0;
    return node;
  }

  void compute(const std::vector<double>& gaps) {
    run_all(gaps, [this](double z_0, const PassageRunner& run) { nodes_[z_0] = solve(z_0, run); });
  }

  // Returns R_n at a gap where it is about `near`, without making a node there; NaN if it cannot be computed.
  // Adds the number of computed passages to `passages`.
  double searched_load(double z_0, double near, const PassageRunner& run, long& passages) {
    if (const auto node = nodes_.find(z_0); node != nodes_.end()) return node->second.value[R_N];
    BrushMean mean(brush_, z_0, run);
    const Ensemble& e = mean.precise_load(near);
    passages += e.passages;
    return e.incomplete == 0 ? e.mean[R_N] : std::numeric_limits<double>::quiet_NaN();
  }

  // Adds the node that a search has found.
  void add_found(double z_0, const PassageRunner& run, long passages) {
    if (nodes_.contains(z_0) || !has_room_for(1)) return;
    ++pending_;
    PointResult node = solve(z_0, run);
    --pending_;
    node.passages += passages;
    nodes_[z_0] = node;
  }
  double load(double z_0) const { return nodes_.at(z_0).value[R_N]; }
  double error(double z_0) const { return nodes_.at(z_0).error[R_N]; }
  bool has_room_for(long nodes) const { return long(nodes_.size()) + pending_ + nodes <= trace_.nodes; }

  std::vector<double> gaps() const {
    std::vector<double> out;
    for (const auto& [z_0, node] : nodes_)
      if (std::isfinite(node.value[R_N])) out.push_back(z_0);
    return out;
  }

  // Halves the intervals beside nodes whose R_n deviates from the chord of their neighbours. Returns false if
  // there are no such nodes, or if halving would exceed the maximum number of nodes: then they get the status
  // not_converged.
  bool refine() {
    const std::vector<double> z = gaps();
    std::vector<double> between, unresolved;
    const auto halve = [&](std::size_t i) {
      const double middle = (z[i] + z[i + 1]) / 2;
      if (nodes_.contains(middle)) {  // incomplete: the curve cannot be resolved here
        nodes_[z[i]].status = nodes_[z[i + 1]].status = PointStatus::not_converged;
        return;
      }
      if (z[i + 1] - z[i] > kClosest && (between.empty() || between.back() != middle))
        between.push_back(middle);
    };
    for (std::size_t i = 1; i + 1 < z.size(); ++i) {
      const double share = (z[i] - z[i - 1]) / (z[i + 1] - z[i - 1]);
      const double chord = load(z[i - 1]) + share * (load(z[i + 1]) - load(z[i - 1]));
      const double noise = error(z[i - 1]) + error(z[i]) + error(z[i + 1]);
      const double allowed = trace_.resolution * std::max(std::abs(load(z[i])), kSmallLoad);
      if (std::abs(load(z[i]) - chord) <= allowed + noise) continue;
      unresolved.push_back(z[i]);
      halve(i - 1);
      halve(i);
    }
    if (between.empty()) return false;
    if (!has_room_for(long(between.size()) + kReservedNodes)) {
      for (const double z_0 : unresolved) nodes_[z_0].status = PointStatus::not_converged;
      return false;
    }
    compute(between);
    return true;
  }

  std::vector<double> gaps_in_order(double sign) const {
    std::vector<double> z = gaps();
    if (sign > 0) std::reverse(z.begin(), z.end());
    return z;
  }

  // Returns whether R_n has turned back from the extreme of the path by no more than the errors or the
  // minimum fold depth.
  bool on_path(double z_0, double extreme_at, double sign) const {
    const double allowed = kMinFoldDepth * trace_.resolution * std::max(load(z_0), kSmallLoad);
    return sign * (load(z_0) - load(extreme_at)) >= -std::max(error(z_0) + error(extreme_at), allowed);
  }

  std::vector<Fold> folds() const {
    std::vector<Fold> out;
    for (const double sign : {1.0, -1.0}) {
      const std::vector<double> z = gaps_in_order(sign);
      std::size_t extreme = 0;
      for (std::size_t i = 1; i < z.size(); ++i) {
        const bool leaves = on_path(z[i - 1], z[extreme], sign) && !on_path(z[i], z[extreme], sign);
        if (leaves && extreme > 0) out.push_back({sign, z[extreme - 1], z[extreme], z[extreme + 1]});
        if (sign * (load(z[i]) - load(z[extreme])) > 0) extreme = i;
      }
    }
    return out;
  }

  // Adds a node at the extreme of R_n between the neighbours of the fold.
  void refine_fold(const Fold& fold, const PassageRunner& run) {
    const auto [low, high] = std::minmax(fold.before, fold.after);
    const double top = load(fold.at);
    long passages = 0;
    const auto negated_load = [&](double z_0) { return -fold.sign * searched_load(z_0, top, run, passages); };
    std::uintmax_t iterations = kSearchSteps;
    const auto [extreme, value] =
        boost::math::tools::brent_find_minima(negated_load, low, high, 12, iterations);
    add_found(extreme, run, passages);
  }

  // Finds the intervals in which the slab lands after a jump from one of the folds.
  std::vector<Landing> landings(const std::vector<Fold>& folds) const {
    std::vector<Landing> out;
    for (const Fold& fold : folds) {
      const std::vector<double> z = gaps_in_order(fold.sign);
      const auto before = std::find(z.begin(), z.end(), fold.before);
      const auto after = std::find(before, z.end(), fold.after);
      double extreme = load(fold.at);
      for (auto at = before; at != after; ++at)
        if (fold.sign * (load(*at) - extreme) > 0) extreme = load(*at);
      for (auto near = after; near != z.end() && std::next(near) != z.end(); ++near) {
        const double far = *std::next(near);
        if (!(fold.sign * (load(*near) - extreme) < 0 && fold.sign * (load(far) - extreme) > 0)) continue;
        out.push_back({*near, far, extreme});
        break;
      }
    }
    return out;
  }

  // Adds nodes on both sides of the gap at which R_n equals the load at the fold.
  void refine_landing(const Landing& landing, const PassageRunner& run) {
    long passages = 0;
    const auto excess = [&](double z_0) {
      return searched_load(z_0, landing.load, run, passages) - landing.load;
    };
    const auto [low, high] = std::minmax(landing.near, landing.far);
    const auto close = [](double a, double b) { return b - a < kClosest; };
    std::uintmax_t iterations = kSearchSteps;
    std::pair landing_gaps(low, high);
    // Without a change of sign, as the loads have errors and may be missing, the nodes found before remain.
    if (const double at_low = excess(low), at_high = excess(high); at_low * at_high < 0)
      landing_gaps = boost::math::tools::toms748_solve(excess, low, high, at_low, at_high, close, iterations);
    add_found(landing_gaps.first, run, passages);
    add_found(landing_gaps.second, run, 0);
  }

  std::vector<CurveNode> nodes_with_branches() {
    std::map<double, int> branches;
    for (const int path : {1, 2}) {
      const double sign = path == 1 ? 1 : -1;
      const std::vector<double> z = gaps_in_order(sign);
      double extreme = z.empty() ? 0 : z.front();
      for (const double z_0 : z) {
        if (!on_path(z_0, extreme, sign)) continue;
        branches[z_0] |= path;
        if (sign * (load(z_0) - load(extreme)) > 0) extreme = z_0;
      }
    }
    std::vector<CurveNode> out;
    for (auto node = nodes_.rbegin(); node != nodes_.rend(); ++node)
      out.push_back({node->second, Branch(branches[node->first])});
    return out;
  }

  const Setup& setup_;
  const Trace& trace_;
  const PassageRunner& run_;
  Brush brush_{setup_};
  std::map<double, PointResult> nodes_;  // by gap
  long pending_ = 0;                     // nodes being computed by searches
};

}  // namespace

std::vector<CurveNode> trace_curve(const Setup& setup, const Trace& trace, const PassageRunner& run) {
  return Tracer(setup, trace, run).trace();
}

}  // namespace bristle
