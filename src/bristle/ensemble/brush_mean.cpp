#include "bristle/ensemble/brush_mean.hpp"

#include "bristle/dynamics/jobs.hpp"
#include "bristle/model/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bristle {

Brush::Member::Member(const Setup& nominal, const DeviatingBristle& bristle)
    : setup{bristle.parameters, nominal.orientation, nominal.integrator, nominal.scatter,
            nominal.max_evaluations_per_point},
      length(bristle.unit.length),
      unit(units_of(bristle)),
      starts(setup.parameters) {}

Brush::Brush(const Setup& setup)
    : deviations_(setup.scatter.any() ? representative_deviations(setup.scatter)
                                      : std::vector<Deviations>(1)) {
  for (const Deviations& by : deviations_) members_.emplace_back(setup, deviating(setup.parameters, by));
}

double Brush::first_contact() const {
  double highest = 0;
  for (const Member& member : members_)
    highest = std::max(highest, member.length * sin(member.setup.parameters.phi_0));
  return highest;
}

Start Brush::start() {
  const Start first = members_.front().starts.start();
  const bool same = std::ranges::all_of(members_, [&](Member& one) { return one.starts.start() == first; });
  return same ? first : Start::undetermined;
}

BrushMean::Part::Part(Brush::Member& of, double z_0, const PassageRunner& runner)
    : member(of),
      run(&runner),
      mean(of.setup, z_0 / of.length, of.starts.at(z_0 / of.length),
           [this](const std::vector<PassageTask>& tasks) { return (*run)(tasks); }) {}

BrushMean::BrushMean(Brush& brush, double z_0, PassageRunner run) : brush_(brush), run_(std::move(run)) {
  for (Brush::Member& member : brush.members()) parts_.emplace_back(member, z_0, run_);
  rtol_ = brush.members().front().setup.orientation.rtol;
  out_.z_0 = z_0;
}

template <class Refine>
const Ensemble& BrushMean::refine(Refine refine_one) {
  if (single()) return refine_one(parts_.front());
  std::vector<Job> jobs;
  for (Part& part : parts_)
    jobs.push_back([&part, refine_one](const PassageRunner& run) {
      const PassageRunner* before = std::exchange(part.run, &run);
      refine_one(part);
      part.run = before;
    });
  run_together(jobs, run_);
  return combine();
}

const Ensemble& BrushMean::combine() {
  const double share = 1 / double(parts_.size());
  Ensemble out;
  out.z_0 = out_.z_0;
  for (const Part& part : parts_) {
    const Ensemble& one = part.mean.known();
    for (Observable k = 0; k < OBSERVABLES; ++k) {
      const double unit = share * part.member.unit[k];
      out.mean[k] += unit * one.mean[k];
      out.error[k] += unit * one.error[k];
      out.integrator_error[k] += unit * one.integrator_error[k];
    }
    out.converged = out.converged && one.converged;
    out.passages += one.passages;
    if (one.incomplete > 0 && out.incomplete == 0) out.incomplete_theta_0 = one.incomplete_theta_0;
    out.incomplete += one.incomplete;
  }
  return out_ = out;
}

const Ensemble& BrushMean::load(const Ensemble& (EnsembleMean::*refine_load)(double), double R_n_target,
                                double rtol) {
  const auto unit_of = [](const Part& part) { return part.member.unit[R_N]; };
  const Ensemble& first = refine(
      [&](Part& part) -> const Ensemble& { return (part.mean.*refine_load)(R_n_target / unit_of(part)); });
  if (single() || first.incomplete > 0) return first;
  const double distance = std::abs(first.mean[R_N] - R_n_target);
  if (first.error[R_N] <= std::max(distance / 4, rtol * R_n_target)) return first;
  // The load of a member may be far from the target although the mean is near it. A target at this distance
  // from a member's own load makes the error of the member as small as the error of the mean must be.
  return refine([&](Part& part) -> const Ensemble& {
    return (part.mean.*refine_load)(part.mean.known().mean[R_N] + 4 * rtol * R_n_target / unit_of(part));
  });
}

const Ensemble& BrushMean::rough_load(double R_n_target) {
  return load(&EnsembleMean::rough_load, R_n_target, 4 * rtol_);
}

const Ensemble& BrushMean::precise_load(double R_n_target) {
  return load(&EnsembleMean::precise_load, R_n_target, rtol_ / 2);
}

const Ensemble& BrushMean::known() const { return single() ? parts_.front().mean.known() : out_; }

const Ensemble& BrushMean::full() {
  return refine([](Part& part) -> const Ensemble& { return part.mean.full(); });
}

bool BrushMean::interrupt() { return single() && parts_.front().mean.interrupt(); }

const Ensemble& BrushMean::with_integrator_error() {
  refine([](Part& part) -> const Ensemble& { return part.mean.with_integrator_error(); });
  if (single()) return known();
  for (Observable k = 0; k < OBSERVABLES; ++k) {
    std::vector<double> values;
    for (const Part& part : parts_) values.push_back(part.member.unit[k] * part.mean.known().mean[k]);
    out_.error[k] += scatter_error(brush_.deviations(), values);
  }
  return out_;
}

EnsembleMean::Difference BrushMean::difference_to(const BrushMean& other) const {
  EnsembleMean::Difference out;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const EnsembleMean::Difference one = parts_[i].mean.difference_to(other.parts_[i].mean);
    if (single()) return one;
    for (Observable k = 0; k < OBSERVABLES; ++k) {
      const double unit = parts_[i].member.unit[k] / double(parts_.size());
      out.mean[k] += unit * one.mean[k];
      out.error[k] += unit * one.error[k];
    }
  }
  return out;
}

long BrushMean::count() const {
  long out = 0;
  for (const Part& part : parts_) out += part.mean.count();
  return out;
}

}  // namespace bristle
