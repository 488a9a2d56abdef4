#include "ensemble/ensemble.hpp"

#include "ensemble/integrator_error.hpp"
#include "model/elementary.hpp"
#include "model/friction/laws.hpp"

#include <algorithm>
#include <cmath>

namespace bristle {
namespace {

// rough_load() refines to at most this multiple of the tolerance.
constexpr double kRoughFactor = 4;

// Maximum panel width (rad) of precise_load() and full(). Nodes are then at most 2.5 degrees apart, which
// resolves the intervals in which the number of bounces changes (measured in docs/numerics.md).
constexpr double kMaxPanelWidth = 0.35;

// Edges of the first panels. A narrow distribution is integrated around its mean only, over panels of 3 or 4
// standard deviations; beyond the last edge its density is below exp(-40) of the peak.
std::vector<double> initial_edges(const Orientation& o, bool half_circle) {
  if (const double sigma = standard_deviation(o); 9 * sigma < M_PI) {
    if (half_circle && cos(o.mean) > 0) return {0, 2 * sigma, 5 * sigma, 9 * sigma};
    if (half_circle) return {M_PI - 9 * sigma, M_PI - 5 * sigma, M_PI - 2 * sigma, M_PI};
    std::vector<double> edges;
    for (const double multiple : {-9, -5, -2, 0, 2, 5, 9}) edges.push_back(o.mean + multiple * sigma);
    return edges;
  }
  // Bristles that point against the motion contribute most: they get their own panel.
  const double head_on = M_PI / 6;
  if (half_circle) return {0, M_PI - head_on, M_PI};
  return {-M_PI, -M_PI + head_on, 0, M_PI - head_on, M_PI};
}

// Where the tip crosses the pole, bristles that are nearly head-on differ from the one that is exactly
// head-on, at a node of the quadrature: they may become pinned as they pass the pole within its range, or
// cross it and stay. These azimuths get panels of their own, of 1, 16 and 40 ranges lambda.
std::vector<double> with_pole_panels(std::vector<double> edges, const Parameters& p) {
  if (p.pole_rule != PoleRule::cross) return edges;
  for (const double ranges : {1., 16., 40.})
    for (const double edge : {-M_PI + ranges * p.lambda, M_PI - ranges * p.lambda})
      if (edges.front() < edge && edge < edges.back())
        edges.insert(std::upper_bound(edges.begin(), edges.end(), edge), edge);
  return edges;
}

}  // namespace

ObservableArray observables(const Passage& passage, double L_x) {
  ObservableArray o{};
  for (std::size_t k = 0; k < kObservables.size(); ++k) o[k] = kObservables[k].value(passage, L_x);
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

EnsembleMean::EnsembleMean(const Setup& setup, double z_0, PassageRunner run)
    : setup_(setup),
      run_(std::move(run)),
      start_(initial_state(setup.parameters, z_0)),
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
    sample.valid = one.complete();
    sample.value = observables(one, setup_.parameters.L_x);
    if (half_circle_) sample.value[R_Y] = 0;  // cancels against the mirror image
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
  return refine(rough);
}

const Ensemble& EnsembleMean::precise_load(double R_n_target) {
  QuadratureGoal precise = goal();
  precise.rtol[R_N] = setup_.orientation.rtol / 2;
  precise.threshold = R_n_target;
  return refine(precise);
}

const Ensemble& EnsembleMean::full() {
  QuadratureGoal all = goal();
  all.max_panel_width = kMaxPanelWidth;
  for (std::size_t k = 0; k < kObservables.size(); ++k)
    if (kObservables[k].controlled && !(half_circle_ && k == R_Y)) all.rtol[k] = setup_.orientation.rtol;
  return refine(all);
}

const Ensemble& EnsembleMean::refine(const QuadratureGoal& goal) {
  if (checked_) return *checked_;
  if (!quadrature_) {
    if (passages_.empty()) average_list();
    return out_;
  }
  const auto& result = quadrature_->refine(goal);
  out_.mean = result.integral;
  out_.error = result.error;
  const double missing = std::abs(out_.mean[WEIGHT] - 1);
  out_.converged = result.status == QuadratureStatus::converged &&
                   missing <= std::max(setup_.orientation.rtol, out_.error[WEIGHT]);
  out_.jumps = result.jumps;
  return out_;
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
  ObservableArray& more = checked_->integrator_error = integrator_error(
      weighted_passages(), setup_.parameters.L_x, [this](const Passage& p) { return task(p.theta_0); }, run_,
      checked_->passages);
  if (half_circle_) more[R_Y] = 0;
  for (std::size_t k = 0; k < OBSERVABLES; ++k) checked_->error[k] += more[k];
  return *checked_;
}

void EnsembleMean::average_list() {
  const std::vector<Passage> all = run(setup_.orientation.theta_0);
  for (const Passage& one : all) {
    const ObservableArray value = observables(one, setup_.parameters.L_x);
    for (std::size_t k = 0; k < OBSERVABLES; ++k) out_.mean[k] += value[k] / double(all.size());
  }
}

double rigid_friction(const Parameters& p, double R_n) {
  return with_law(p.friction, [&](auto law) { return law.rigid(p, R_n); });
}

}  // namespace bristle
