#include "bristle/ensemble/point.hpp"

#include "bristle/ensemble/brush_mean.hpp"
#include "bristle/model/friction/laws.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace bristle {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Smallest relative change of an observable, as a share of the relative change of the load. Where the
// observable has an extremum over the gap, neighbouring gaps show no change with the load.
constexpr double kLeastSensitivity = 0.01;

// Sets the errors due to a deviation of the load from its target (in units of R_n) to at least the change of
// the values on the way to the gap of `other`: the share of the difference that corresponds to the deviation,
// or all of it if the loads at both gaps differ by less than the deviation. Errors that are already larger
// remain.
void add_load_error(PointResult& out, const Ensemble& other, double deviation) {
  const double span = std::abs(other.mean[R_N] - out.value[R_N]);
  const double share = span > deviation ? deviation / span : 1;
  for (std::size_t k = 0; k < OBSERVABLES; ++k)
    if (k != R_N)
      out.load_error[k] = std::max(out.load_error[k], std::abs(other.mean[k] - out.value[k]) * share);
  out.z_0_error = std::max(out.z_0_error, std::abs(other.z_0 - out.z_0) * share);
}

void normalise(PointResult& out, const Parameters& p) {
  const double R_rigid = out.value[R_N] < kNoLoad ? NAN : rigid_friction(p, out.value[R_N]);
  const double power = with_law(p.friction, [](auto law) { return law.load_exponent; });
  const double load = power * out.error[R_N] / out.value[R_N];
  const auto over_rigid = [&](Observable k) {
    const double value = out.value[k] / R_rigid;
    return Quantity{value, out.error[k] / R_rigid + std::abs(value) * load, out.load_error[k] / R_rigid};
  };
  out.R_x_norm = over_rigid(R_X);
  out.R_y_norm = over_rigid(R_Y);
}

// Returns the status of a converged point.
PointStatus quality(const Parameters& p, const PointResult& out) {
  if (conserves_energy(p.bending) && out.value[ENERGY_RESIDUAL] > kMaxEnergyResidual)
    return PointStatus::inaccurate;
  const auto finite = [](double value) { return std::isfinite(value); };
  const bool defined = std::isfinite(out.R_x_norm.value) && std::ranges::all_of(out.value, finite) &&
                       std::ranges::all_of(out.error, finite);
  return defined ? PointStatus::ok : PointStatus::undefined;
}

struct WorkLimitReached {};

class PointSolver {
 public:
  PointSolver(const Setup& setup, const Loading& loading, const PassageRunner& run, const Recording& record,
              Recorded& recorded)
      : setup_(setup), loading_(loading), run_(run), record_(record), recorded_(recorded) {}

  PointResult solve() {
    PointResult out;
    try {
      out = ensemble_values();
    } catch (const WorkLimitReached&) {
      out = without_values(PointStatus::work_limit);
    }
    if (setup_.orientation.sampling == Sampling::lattice && std::isfinite(out.z_0)) out = lattice_values(out);
    out.start = brush_.start();
    out.passages = lattice_passages_;
    for (const auto& [z_0, mean] : means_) out.passages += mean.count();
    if (std::isfinite(out.z_0)) {
      const bool of_mean = setup_.orientation.sampling != Sampling::lattice;
      if (record_.bristles && of_mean) record_bristles(out.z_0);
      record_trajectories(out.z_0);
    }
    return out;
  }

 private:
  PointResult ensemble_values() {
    if (loading_.z_0) return at_given_gap(*loading_.z_0);
    const LoadPoint found = search();
    if (found.status == LoadStatus::unreachable) return unreachable();
    if (found.status == LoadStatus::failed) return incomplete();
    PointResult out = at_gap(found.z_0, found.status);
    if (out.status == PointStatus::incomplete) return out;
    if (found.status == LoadStatus::load_jump) {
      out.jump_z_0 = found.jump_z_0;
      out.jump_R_n = found.jump_R_n;
    } else {
      if (found.even_between) move_to_target(out, *found.even_between);
      else add_load_errors(out, found);
    }
    if (found.ambiguous) out.status = PointStatus::ambiguous;
    if (found.z_0_other) {
      const PointResult other =
          values_of(setup_.parameters, mean_at(*found.z_0_other).with_integrator_error());
      out.z_0_other = other.z_0;
      out.value_other = other.value;
      out.R_x_norm_other = other.R_x_norm.value;
    }
    return out;
  }

  // Change of the values and of the gap with R_n between the gap of the values and another gap.
  struct Secant {
    double weight;  // two secants with these weights give the slope of the parabola through all three gaps
    ObservableArray slope{}, error{};
    double z_0_slope, z_0_error;
  };
  Secant secant(double z_0, double other) {
    const EnsembleMean::Difference d = mean_at(z_0).difference_to(mean_at(other));
    Secant out;
    const double rise = d.mean[R_N], relative = d.error[R_N] / std::abs(rise);
    out.weight = 1 / std::abs(rise);
    for (std::size_t k = 0; k < OBSERVABLES; ++k) {
      out.slope[k] = d.mean[k] / rise;
      out.error[k] = d.error[k] / std::abs(rise) + std::abs(out.slope[k]) * relative;
    }
    out.z_0_slope = (other - z_0) / rise;
    out.z_0_error = std::abs(out.z_0_slope) * relative;
    return out;
  }

  // Moves the values and the gap to the target load by secants to the gaps on both sides (`between`). The
  // uncertainty of the slopes and the error of the load itself add to the errors.
  void move_to_target(PointResult& out, const std::array<double, 2>& between) {
    const double at = out.z_0, missing = loading_.R_n - out.value[R_N], load_error = out.error[R_N];
    const Secant a = secant(at, between[0]), b = secant(at, between[1]);
    const ObservableArray &before = mean_at(between[0]).known().mean,
                          &after = mean_at(between[1]).known().mean;
    const auto move = [&](double& value, double& error, double slope_a, double slope_b, double slope_error) {
      const double slope = (a.weight * slope_a + b.weight * slope_b) / (a.weight + b.weight);
      const double steepest = std::max(std::abs(slope_a), std::abs(slope_b));
      const double spread = std::max(std::abs(slope_a - slope), std::abs(slope_b - slope));
      value += missing * slope;
      error =
          std::abs(missing) * std::sqrt(spread * spread + slope_error * slope_error) + steepest * load_error;
    };
    for (std::size_t k = 0; k < OBSERVABLES; ++k) {
      if (k == R_N) continue;
      const double least = std::min({out.value[k], before[k], after[k]});
      move(out.value[k], out.load_error[k], a.slope[k], b.slope[k], std::max(a.error[k], b.error[k]));
      if (least >= 0) out.value[k] = std::max(out.value[k], 0.0);  // shares and counts stay positive or zero
      const double relative = (std::abs(missing) + load_error) / loading_.R_n;
      out.load_error[k] = std::max(out.load_error[k], kLeastSensitivity * std::abs(out.value[k]) * relative);
      out.error[k] += out.load_error[k];
    }
    move(out.z_0, out.z_0_error, a.z_0_slope, b.z_0_slope, std::max(a.z_0_error, b.z_0_error));
    out.value[R_N] = loading_.R_n;
    normalise(out, setup_.parameters);
  }

  void add_load_errors(PointResult& out, const LoadPoint& found) {
    const double distance = std::abs(out.value[R_N] - loading_.R_n), deviation = distance + out.error[R_N];
    for (const double z_0 : {found.z_0_near, found.z_0_far})
      add_load_error(out, mean_at(z_0).known(), deviation);
    add_nearest(out, std::make_reverse_iterator(means_.find(out.z_0)), means_.rend(), deviation);
    add_nearest(out, std::next(means_.find(out.z_0)), means_.end(), deviation);
    for (std::size_t k = 0; k < OBSERVABLES; ++k) {
      const double least = kLeastSensitivity * std::abs(out.value[k]) * deviation / loading_.R_n;
      if (k != R_N) out.load_error[k] = std::max(out.load_error[k], least);
      out.error[k] += out.load_error[k];
    }
    normalise(out, setup_.parameters);
    if (out.status == PointStatus::ok && distance > setup_.orientation.rtol * loading_.R_n)
      out.status = PointStatus::not_converged;
  }

  // Adds the load error by the nearest gap, from `from` on, whose load differs by at least the deviation.
  template <class Iterator>
  void add_nearest(PointResult& out, Iterator from, Iterator to, double deviation) {
    for (; from != to; ++from) {
      const Ensemble& other = from->second.known();
      if (!(std::abs(other.mean[R_N] - out.value[R_N]) >= deviation)) continue;
      add_load_error(out, other, deviation);
      return;
    }
  }

  // Returns the result of a point whose target no gap carries, with the greatest load that one does. The
  // search knows the loads only as exactly as they are below the target.
  PointResult unreachable() {
    constexpr int kHalvings = 3;
    PointResult out = without_values(PointStatus::unreachable);
    const auto largest = [this] {
      return std::ranges::max_element(means_, {}, [](auto& one) { return one.second.known().mean[R_N]; });
    };
    try {
      for (int i = 0; i < kHalvings; ++i) {
        const auto above = 1.25 * largest()->second.known().mean[R_N];
        for (auto& [z_0, mean] : means_) mean.rough_load(above);
        const auto top = largest();
        const double at = top->first;
        std::vector<double> between;
        if (top != means_.begin()) between.push_back((std::prev(top)->first + at) / 2);
        if (std::next(top) != means_.end()) between.push_back((std::next(top)->first + at) / 2);
        for (const double z_0 : between)
          if (mean_at(z_0).rough_load(above).incomplete > 0) return out;
      }
      const double z_0 = largest()->first;
      const Ensemble& e = mean_at(z_0).with_integrator_error();
      if (e.incomplete > 0) return out;
      out.z_0_of_R_n_largest = z_0;
      out.R_n_largest = {e.mean[R_N], e.error[R_N], 0};
    } catch (const WorkLimitReached&) {
    }
    return out;
  }

  LoadPoint search() {
    LoadSearch search;
    search.target = loading_.R_n;
    search.path = loading_.path;
    search.rtol = setup_.orientation.rtol;
    // The mean over a few azimuths need not be smooth over the gap.
    search.by_secants = setup_.orientation.sampling != Sampling::list;
    search.first_contact = brush_.first_contact();
    search.contact_range = contact_range(setup_.parameters);
    return first_crossing([this](double z_0, Accuracy accuracy) { return load_at(z_0, accuracy); }, search);
  }

  // Returns R_n at a gap. Unless the accuracy is rough, a load near the target is as accurate as the reported
  // values.
  Load load_at(double z_0, Accuracy accuracy) {
    BrushMean& mean = mean_at(z_0);
    const Ensemble* e = &mean.rough_load(loading_.R_n);
    const auto distance = [&] { return std::abs(e->mean[R_N] - loading_.R_n); };
    const bool rough = accuracy == Accuracy::rough;
    if (e->incomplete == 0 && !rough) e = &mean.precise_load(loading_.R_n);
    const double near =
        std::max(2 * setup_.orientation.rtol * loading_.R_n, e->converged ? 0 : e->error[R_N]);
    if (e->incomplete == 0 && !rough && distance() <= near) e = &mean.full();
    if (e->incomplete == 0 && accuracy == Accuracy::reported) e = &mean.with_integrator_error();
    if (e->incomplete == 0) return {e->mean[R_N], e->error[R_N], e->converged};
    incomplete_theta_0_ = e->incomplete_theta_0;
    return {kNone, kNone};
  }

  BrushMean& mean_at(double z_0) {
    if (const auto known = means_.find(z_0); known != means_.end()) return known->second;
    return means_.try_emplace(z_0, brush_, z_0, limited_run_).first->second;
  }

  std::vector<Passage> run_within_limit(const std::vector<PassageTask>& tasks) {
    if (limited_ && evaluations_ > setup_.max_evaluations_per_point) throw WorkLimitReached{};
    std::vector<Passage> passages = run_(tasks);
    for (const Passage& one : passages) evaluations_ += one.evaluations;
    return passages;
  }

  PointResult incomplete() const {
    PointResult out = without_values(PointStatus::incomplete);
    out.incomplete_theta_0 = incomplete_theta_0_;
    return out;
  }

  // Returns the values at a given gap. If the limit of work ends a mean over alternating outcomes, returns
  // its values so far, which are not converged. The estimate of the integrator's error may then exceed the
  // limit by some dozens of passages.
  PointResult at_given_gap(double z_0) {
    try {
      return at_gap(z_0, LoadStatus::reached);
    } catch (const WorkLimitReached&) {
      if (!mean_at(z_0).interrupt()) throw;
      limited_ = false;
      return at_gap(z_0, LoadStatus::reached);
    }
  }

  PointResult at_gap(double z_0, LoadStatus status) {
    const Ensemble& ensemble = mean_at(z_0).with_integrator_error();
    integrator_error_ = ensemble.integrator_error;
    PointResult out = values_of(setup_.parameters, ensemble);
    if (status == LoadStatus::load_jump && out.status != PointStatus::incomplete)
      out.status = PointStatus::load_jump;
    return out;
  }

  // Returns the values of the lattice at the gap of the ensemble mean, in place of the values of this mean.
  PointResult lattice_values(const PointResult& mean) {
    LatticeMean lattice = lattice_mean(setup_, mean.z_0, run_);
    lattice_passages_ = long(lattice.passages.size());
    PointResult out = mean;
    if (lattice.incomplete > 0) {
      incomplete_theta_0_ = lattice.incomplete_theta_0;
      return incomplete();
    }
    out.value = lattice.mean;
    out.error = lattice.error;
    for (std::size_t k = 0; k < OBSERVABLES; ++k) out.error[k] += integrator_error_[k];
    out.load_error.fill(0);
    out.fluctuation = lattice.fluctuation;
    out.fluctuation_of_rows = lattice.fluctuation_of_rows;
    normalise(out, setup_.parameters);
    if (record_.bristles) recorded_.bristles = std::move(lattice.passages);
    if (record_.slab_force) recorded_.slab_force = std::move(lattice.force);
    return out;
  }

  // Records the passages of the mean at the gap of the values. Computes this mean if the values were moved to
  // a gap that the search has not computed.
  void record_bristles(double z_0) {
    if (const auto known = means_.find(z_0); known != means_.end()) {
      recorded_.bristles = known->second.passages();
      return;
    }
    BrushMean mean(brush_, z_0, run_);
    mean.full();
    recorded_.bristles = mean.passages();
  }

  void record_trajectories(double z_0) {
    const Parameters& p = setup_.parameters;
    const Equilibrium start = InitialStates(p).at(z_0);
    for (const double theta_0 : record_.trajectories)
      recorded_.trajectories.push_back(
          record_trajectory({&p, make_bristle(p, z_0, theta_0), start, setup_.integrator}));
  }

  const Setup& setup_;
  const Loading& loading_;
  const PassageRunner& run_;
  const Recording& record_;
  Recorded& recorded_;
  Brush brush_{setup_};
  const PassageRunner limited_run_ = [this](const auto& tasks) { return run_within_limit(tasks); };
  long evaluations_ = 0;
  bool limited_ = true;                // whether max_evaluations_per_point applies
  std::map<double, BrushMean> means_;  // by gap
  long lattice_passages_ = 0;
  ObservableArray integrator_error_{};  // part of the errors of the values that the integrator causes
  double incomplete_theta_0_ = kNone;   // azimuth of a passage without an exit, rad
};

}  // namespace

PointResult without_values(PointStatus status) {
  PointResult out;
  out.status = status;
  out.z_0 = out.z_0_error = kNone;
  out.value.fill(kNone);
  out.error.fill(kNone);
  out.R_x_norm = out.R_y_norm = {kNone, kNone, kNone};
  out.load_error.fill(kNone);
  out.fluctuation = out.fluctuation_of_rows = {kNone, kNone, kNone};
  out.jump_z_0 = out.jump_R_n = out.incomplete_theta_0 = kNone;
  out.R_n_largest = {kNone, kNone, kNone};
  out.z_0_of_R_n_largest = out.z_0_other = out.R_x_norm_other = kNone;
  out.value_other.fill(kNone);
  return out;
}

PointResult values_of(const Parameters& parameters, const Ensemble& ensemble) {
  if (ensemble.incomplete > 0) {
    PointResult out = without_values(PointStatus::incomplete);
    out.incomplete_theta_0 = ensemble.incomplete_theta_0;
    return out;
  }
  PointResult out = without_values(ensemble.converged ? PointStatus::ok : PointStatus::not_converged);
  out.z_0 = ensemble.z_0;
  out.z_0_error = 0;
  out.value = ensemble.mean;
  out.error = ensemble.error;
  out.load_error.fill(0);
  normalise(out, parameters);
  if (out.status == PointStatus::ok) out.status = quality(parameters, out);
  return out;
}

PointResult solve_point(const Setup& setup, const Loading& loading, const PassageRunner& run,
                        const Recording& record, Recorded* recorded) {
  Recorded unused;
  return PointSolver(setup, loading, run, record, recorded ? *recorded : unused).solve();
}

}  // namespace bristle
