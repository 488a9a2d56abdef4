#include "interface/point.hpp"

#include <cmath>
#include <limits>
#include <map>

namespace bristle {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

PointResult without_values(PointStatus status) {
  PointResult out;
  out.status = status;
  out.z_0 = out.z_0_error = kNone;
  out.value.fill(kNone);
  out.error.fill(kNone);
  out.R_x_norm = out.R_x_norm_error = out.R_y_norm = out.R_y_norm_error = kNone;
  out.jump_z_0 = out.jump_R_n = out.incomplete_theta_0 = kNone;
  return out;
}

// Ensemble means at the gaps of a load search.
using Visited = std::map<double, Ensemble>;

// Adds to the errors what a load off its target by off (R_n units) changes, from the secant through
// the scan's gaps on both sides of the crossing.
void add_load_error(PointResult& out, const Ensemble& near, const Ensemble& far, double off) {
  const double span = std::abs(far.mean[R_N] - near.mean[R_N]);
  if (span == 0) return;
  const double share = off / span;
  for (std::size_t k = 0; k < OBSERVABLES; ++k)
    if (k != R_N) out.error[k] += std::abs(far.mean[k] - near.mean[k]) * share;
  out.z_0_error = std::abs(far.z_0 - near.z_0) * share;
}

void normalise(PointResult& out, const Parameters& p) {
  const double R_rigid = rigid_friction(p, out.value[R_N]);
  const double power = p.friction == FrictionLaw::nss ? 2.0 / 3 : 1.0;
  const double load = power * out.error[R_N] / out.value[R_N];
  out.R_x_norm = out.value[R_X] / R_rigid;
  out.R_y_norm = out.value[R_Y] / R_rigid;
  out.R_x_norm_error = out.error[R_X] / R_rigid + std::abs(out.R_x_norm) * load;
  out.R_y_norm_error = out.error[R_Y] / R_rigid + std::abs(out.R_y_norm) * load;
}

}  // namespace

PointResult solve_point(const Interface& interface, const Loading& loading, const PassageObserver& observe) {
  Visited visited;
  long passages = 0;
  double lost = kNone;  // theta_0 of a passage without an exit
  LoadPoint found;
  if (loading.z_0) {
    found.status = LoadStatus::reached;
    found.z_0 = *loading.z_0;
  } else {
    LoadSearch search;
    search.target = loading.R_n;
    search.path = loading.path;
    search.rtol = interface.orientation.rtol;
    search.first_contact = std::sin(interface.parameters.phi_0);
    const LoadCurve curve = [&](double z_0) -> Load {
      auto it = visited.find(z_0);
      if (it == visited.end()) {
        it = visited.emplace(z_0, ensemble_against_target(interface, z_0, loading.R_n)).first;
        passages += it->second.passages;
      }
      const Ensemble& e = it->second;
      if (e.incomplete > 0) {
        lost = e.incomplete_theta_0;
        return {kNone, kNone};
      }
      return {e.mean[R_N], e.error[R_N]};
    };
    found = first_crossing(curve, search);
  }
  PointResult out = without_values(PointStatus::unreachable);
  out.passages = passages;
  if (found.status == LoadStatus::unreachable) return out;
  if (found.status == LoadStatus::failed) {
    out.status = PointStatus::incomplete;
    out.incomplete_theta_0 = lost;
    return out;
  }

  const Ensemble final = ensemble_mean(interface, found.z_0, observe);
  out.passages += final.passages;
  if (final.incomplete > 0) {
    out.status = PointStatus::incomplete;
    out.incomplete_theta_0 = final.incomplete_theta_0;
    return out;
  }
  out.status = found.status == LoadStatus::jump ? PointStatus::jump
               : final.converged                ? PointStatus::ok
                                                : PointStatus::not_converged;
  out.z_0 = found.z_0;
  out.z_0_error = 0;
  out.value = final.mean;
  out.error = final.error;
  if (found.status == LoadStatus::jump) {
    out.jump_z_0 = found.jump_z_0;
    out.jump_R_n = found.jump_R_n;
  } else if (!loading.z_0) {
    const double off = std::abs(final.mean[R_N] - loading.R_n) + final.error[R_N];
    add_load_error(out, visited.at(found.z_0_near), visited.at(found.z_0_far), off);
  }
  normalise(out, interface.parameters);
  return out;
}

}  // namespace bristle
