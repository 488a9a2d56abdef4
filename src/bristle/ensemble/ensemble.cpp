#include "bristle/ensemble/ensemble.hpp"

#include "bristle/ensemble/integrator_error.hpp"
#include "bristle/model/elementary.hpp"
#include "bristle/model/friction/laws.hpp"

#include <algorithm>
#include <cmath>

namespace bristle {
namespace {

// Tolerance of rough_load() for R_n, as a multiple of orientation.rtol.
constexpr double kRoughFactor = 4;
// Maximum number of nodes where outcomes alternate at every scale, for a load search and for the values of a
// point.
constexpr std::size_t kAlternatingForLoad = 128, kAlternatingForValues = 8192;

// Maximum panel widths (rad) of full(), for bristles that point forward and backward. Nodes are then at most
// 2.5 and 1.25 degrees apart, which resolves the intervals in which the number of bounces changes (measured
// in docs/numerics.md). Beside the head-on bristle, which points exactly against the motion, narrow intervals
// of azimuths contain pinned or chattering bristles: a panel there is at most as wide as its distance from
// the head-on bristle, but need not be narrower than kHeadOnPanel.
constexpr double kForwardPanel = 0.35, kBackwardPanel = 0.175, kHeadOnPanel = 0.01;

// If the usual estimate of the integrator's error exceeds kLargeError times the tolerance of a mean, it is
// repeated with kMoreEffort times as many passages.
constexpr double kLargeError = 4;
constexpr std::size_t kMoreEffort = 4;

bool too_wide(bool pole, double left, double right) {
  const double from = from_head_on(left), to = from_head_on(right);
  const double distance = from * to < 0 ? 0 : std::min(std::abs(from), std::abs(to));
  const double rounding = 1e-9;
  const double most = pole ? std::max(distance + rounding, kHeadOnPanel) : kBackwardPanel;
  return right - left > std::min(most, distance < M_PI / 2 - rounding ? kBackwardPanel : kForwardPanel);
}

bool near_pole(const Passage& passage) { return passage.implicit || passage.reflections > 0; }

// Returns the edges of the first panels. A narrow distribution is integrated around its mean only, over
// panels of 3 or 4 standard deviations; beyond the last edge its density is below exp(-40) of the peak.
std::vector<double> initial_edges(const Orientation& o, bool half_circle) {
  if (const double sigma = standard_deviation(o); 9 * sigma < M_PI) {
    if (half_circle && cos(o.mean) > 0) return {0, 2 * sigma, 5 * sigma, 9 * sigma};
    if (half_circle) return {M_PI - 9 * sigma, M_PI - 5 * sigma, M_PI - 2 * sigma, M_PI};
    std::vector<double> edges;
    for (const double multiple : {-9, -5, -2, 0, 2, 5, 9}) edges.push_back(o.mean + multiple * sigma);
    return edges;
  }
  // Bristles that point against the motion contribute most: they get their own panel.
  if (half_circle) return {0, M_PI - kHeadOn, M_PI};
  return {-M_PI, -M_PI + kHeadOn, 0, M_PI - kHeadOn, M_PI};
}

// Adds edges around the head-on azimuth, 1, 16 and 40 ranges lambda away from it, if tips cross the pole.
// Bristles that are nearly head-on then differ from the exactly head-on one, which is a node of the
// quadrature: they may become pinned as they pass within the range of the pole, or cross it and stay.
std::vector<double> with_pole_panels(std::vector<double> edges, const Parameters& p) {
  if (!has_pole(p.bending) || p.pole_rule != PoleRule::cross) return edges;
  for (const double ranges : {1., 16., 40.})
    for (const double edge : {-M_PI + ranges * p.lambda, M_PI - ranges * p.lambda})
      if (edges.front() < edge && edge < edges.back())
        edges.insert(std::upper_bound(edges.begin(), edges.end(), edge), edge);
  return edges;
}

}  // namespace

double load_spread(const Passage& p) {
  const double impulse = p.end[component::NORMAL];
  if (impulse * impulse == 0) return 0;
  return std::sqrt(std::max(p.path[SQUARED_LOAD] * p.contact_time / (impulse * impulse) - 1, 0.0));
}

double angle_of_versed(double versed) {
  return angle_over_sine(versed).value * std::sqrt(versed * (2 - versed));
}

double root_strain(const Parameters& p, double bending) { return 3 * p.R * bending; }

ObservableArray observables(const Passage& passage, const Parameters& parameters) {
  ObservableArray o{};
  for (std::size_t k = 0; k < kObservables.size(); ++k) o[k] = kObservables[k].value(passage, parameters);
  o[WEIGHT] = 1;
  split_by_outcome(o, passage.outcome);
  return o;
}

void split_by_outcome(ObservableArray& o, Outcome outcome) {
  const double is_pinned = outcome == Outcome::pinned ? 1 : 0;
  for (std::size_t k = 0; k < kObservables.size(); ++k) {
    if (kObservables[k].unpinned != Unpinned::none) o[unpinned(k)] = (1 - is_pinned) * o[k];
    if (kObservables[k].unpinned == Unpinned::contribution) o[pinned(k)] = is_pinned * o[k];
  }
}

EnsembleMean::EnsembleMean(const Setup& setup, double z_0, const Equilibrium& start, PassageRunner run)
    : setup_(setup),
      run_(std::move(run)),
      start_(start),
      density_(setup.orientation),
      half_circle_(mirror_symmetric(setup.orientation) && !setup.orientation.full_circle) {
  out_.z_0 = z_0;
  if (setup.orientation.sampling != Sampling::list)
    quadrature_.emplace([this](const std::vector<double>& at) { return samples(at); },
                        with_pole_panels(initial_edges(setup.orientation, half_circle_), setup.parameters));
}

PassageTask EnsembleMean::task(double theta_0) const {
  return {&setup_.parameters, make_bristle(setup_.parameters, out_.z_0, theta_0), start_, setup_.integrator};
}

double EnsembleMean::weight(double theta_0) const { return (half_circle_ ? 2 : 1) * density_(theta_0); }

std::vector<Passage> EnsembleMean::run(const std::vector<double>& theta_0) {
  std::vector<PassageTask> tasks;
  for (const double angle : theta_0) tasks.push_back(task(angle));
  std::vector<Passage> results = run_(tasks);
  for (const Passage& one : results)
    if (!one.complete() && out_.incomplete++ == 0) out_.incomplete_theta_0 = one.theta_0;
  passages_.insert(passages_.end(), results.begin(), results.end());
  out_.passages = long(passages_.size());
  return results;
}

std::vector<Sample> EnsembleMean::samples(const std::vector<double>& theta_0) {
  std::vector<Sample> out;
  for (const Passage& one : run(theta_0)) {
    Sample sample;
    sample.label = int(one.outcome);
    sample.sensitive = near_pole(one);
    sample.valid = one.complete();
    sample.value = observables(one, setup_.parameters);
    if (half_circle_) sample.value[R_Y] = 0;  // the mirror image cancels it
    for (double& value : sample.value) value *= weight(one.theta_0);
    out.push_back(sample);
  }
  return out;
}

QuadratureGoal EnsembleMean::goal() const {
  QuadratureGoal goal;
  for (std::size_t k = 0; k < OBSERVABLES; ++k) goal.scale[k] = k;
  goal.scale[R_Y] = R_X;  // R_y is near zero, so its tolerance is relative to R_x
  goal.rtol[WEIGHT] = setup_.orientation.rtol;
  return goal;
}

const Ensemble& EnsembleMean::rough_load(double R_n_target) {
  QuadratureGoal rough = goal();
  rough.rtol[R_N] = kRoughFactor * setup_.orientation.rtol;
  rough.threshold = R_n_target;
  rough.most_alternating = kAlternatingForLoad;
  return refine(rough);
}

const Ensemble& EnsembleMean::precise_load(double R_n_target) {
  QuadratureGoal precise = goal();
  precise.rtol[R_N] = setup_.orientation.rtol;
  precise.threshold = R_n_target;
  precise.most_alternating = kAlternatingForLoad;
  return refine(precise);
}

const Ensemble& EnsembleMean::full() {
  if (full_) return known();
  QuadratureGoal all = goal();
  all.most_alternating = kAlternatingForValues;
  all.too_wide = [pole = has_pole(setup_.parameters.bending)](double left, double right) {
    return too_wide(pole, left, right);
  };
  for (std::size_t k = 0; k < kObservables.size(); ++k)
    if (kObservables[k].controlled && !(half_circle_ && k == R_Y)) all.rtol[k] = setup_.orientation.rtol;
  refine(all);
  full_ = true;
  if (quadrature_) add_hidden_errors();
  return out_;
}

// Estimates the fraction of bristles whose outcome falls between two nodes. Around the head-on bristle such
// intervals of azimuths are common: half of the gap between nodes counts. Elsewhere beside a bristle that
// came near the pole they are rare: 1/32 of the gap counts (docs/numerics.md).
double EnsembleMean::hidden_fraction() const {
  constexpr double common = 1. / 2, rare = 1. / 32;
  if (!has_pole(setup_.parameters.bending)) return 0;
  std::vector<const Passage*> nodes;
  for (const Passage& one : passages_) nodes.push_back(&one);
  std::ranges::sort(nodes, {}, &Passage::theta_0);
  double hidden = 0;
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    const Passage &left = *nodes[i - 1], &right = *nodes[i];
    if (!near_pole(left) && !near_pole(right)) continue;
    const double from = from_head_on(left.theta_0), to = from_head_on(right.theta_0);
    const double share = from * to <= 0 ? common : rare;
    hidden =
        std::max(hidden, share * (right.theta_0 - left.theta_0) * weight((left.theta_0 + right.theta_0) / 2));
  }
  return hidden;
}

void EnsembleMean::add_hidden_errors() {
  const double hidden = hidden_fraction(), pinned_part = out_.mean[PINNED_FRACTION];
  out_.error[PINNED_FRACTION] += hidden;
  for (Observable k = 0; k < kObservables.size(); ++k) {
    if (kObservables[k].unpinned != Unpinned::contribution) continue;
    double of_pinned = 0;  // contribution of a pinned bristle; the largest of any bristle if none is pinned
    if (pinned_part > 0) of_pinned = std::abs(out_.mean[pinned(k)]) / pinned_part;
    else
      for (const Passage& one : passages_)
        of_pinned = std::max(of_pinned, std::abs(kObservables[k].value(one, setup_.parameters)));
    out_.error[pinned(k)] += hidden * of_pinned;
    out_.error[unpinned(k)] += hidden * std::abs(out_.mean[unpinned(k)]) / std::max(1e-3, 1 - pinned_part);
  }
}

const Ensemble& EnsembleMean::refine(const QuadratureGoal& goal) {
  if (full_) return known();  // the load that decided on this gap stays the same
  if (!quadrature_) {
    if (passages_.empty()) average_list();
    return out_;
  }
  take(quadrature_->refine(goal));
  return out_;
}

void EnsembleMean::take(const QuadratureResult& result) {
  out_.mean = result.integral;
  out_.error = result.error;
  const double missing = std::abs(out_.mean[WEIGHT] - 1);
  out_.converged = result.status == QuadratureStatus::converged &&
                   missing <= std::max(setup_.orientation.rtol, out_.error[WEIGHT]);
  out_.jumps = result.jumps;
}

bool EnsembleMean::interrupt() {
  if (full_ || !quadrature_ || !quadrature_->alternates() || out_.incomplete > 0) return false;
  take(quadrature_->interrupted());
  full_ = true;
  add_hidden_errors();
  return true;
}

std::vector<WeightedPassage> EnsembleMean::weighted_passages() const {
  std::vector<WeightedPassage> out;
  const std::size_t n = passages_.size();
  for (const Passage& one : passages_) out.push_back({&one, 1 / double(n)});
  if (!quadrature_) return out;
  std::sort(out.begin(), out.end(),
            [](const auto& a, const auto& b) { return a.passage->theta_0 < b.passage->theta_0; });
  for (std::size_t i = 0; i < n; ++i) {
    const double from = out[i > 0 ? i - 1 : 0].passage->theta_0,
                 to = out[std::min(i + 1, n - 1)].passage->theta_0;
    out[i].weight = weight(out[i].passage->theta_0) * (to - from) / 2;
  }
  return out;
}

const Ensemble& EnsembleMean::with_integrator_error() {
  if (checked_) return *checked_;
  checked_ = full();
  if (checked_->incomplete > 0) return *checked_;
  ObservableArray& more = checked_->integrator_error;
  const auto estimate = [&](std::size_t effort) {
    more = integrator_error(
        weighted_passages(), setup_.parameters, [this](const Passage& p) { return task(p.theta_0); }, run_,
        effort, checked_->passages);
  };
  const long before = checked_->passages;
  estimate(1);
  const bool all_repeated = checked_->passages - before >= long(passages().size());
  // Among a few repeated passages, one may be far more sensitive than the others.
  const auto is_large = [&](Observable k) {
    return kObservables[k].controlled && k != R_Y &&
           more[k] > kLargeError * setup_.orientation.rtol * std::abs(checked_->mean[k]);
  };
  bool any_large = false;
  for (Observable k = 0; k < kObservables.size(); ++k) any_large = any_large || is_large(k);
  if (any_large && !all_repeated) estimate(kMoreEffort);
  if (half_circle_) more[R_Y] = 0;
  for (std::size_t k = 0; k < OBSERVABLES; ++k) checked_->error[k] += more[k];
  return *checked_;
}

EnsembleMean::Difference EnsembleMean::difference_to(const EnsembleMean& other) const {
  Difference out;
  for (std::size_t k = 0; k < OBSERVABLES; ++k) {
    out.mean[k] = other.out_.mean[k] - out_.mean[k];
    out.error[k] = std::sqrt(other.out_.error[k] * other.out_.error[k] + out_.error[k] * out_.error[k]);
  }
  if (!quadrature_) return out;
  const auto common = quadrature_->difference_to(*other.quadrature_);
  return common && common->error[R_N] < out.error[R_N] ? Difference{common->integral, common->error} : out;
}

void EnsembleMean::average_list() {
  const std::vector<Passage> all = run(setup_.orientation.theta_0);
  for (const Passage& one : all) {
    const ObservableArray value = observables(one, setup_.parameters);
    for (std::size_t k = 0; k < OBSERVABLES; ++k) out_.mean[k] += value[k] / double(all.size());
  }
}

double rigid_friction(const Parameters& p, double R_n) {
  return with_law(p.friction, [&](auto law) { return law.rigid(p, R_n); });
}

}  // namespace bristle
