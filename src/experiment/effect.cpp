#include "experiment/experiment.hpp"
#include "experiment/si_units.hpp"
#include "model/equations.hpp"

#include <algorithm>

namespace bristle::experiment {
namespace {

// All that a point's numbers depend on, beside what the points of an experiment have in common.
std::vector<double> effective_input(const PointInput& point) {
  // The strength of friction and the unit of its speeds are in the setup.
  const auto& [setup, loading, si, friction_law_in_si, nominal_friction] = point;
  Parameters p = setup.parameters;
  if (!has_pole(p.bending)) p.pole_rule = {};
  const Orientation& o = setup.orientation;
  constexpr double any_gap = 0.5, any_azimuth = 1;
  const Bristle<double> bristle = make_bristle(p, loading.z_0.value_or(any_gap), any_azimuth);
  std::vector<double> out = {p.L_x,          p.s_min,         p.spacing,         p.R_c, p.E_star, p.R,
                             p.strain_limit, p.stretch_limit, double(o.sampling)};
  for (const double* constant : constants_of(bristle)) out.push_back(*constant);
  for (const Choice& c : choices()) out.push_back(c.get(p));
  if (!loading.z_0 && !loading.trace) out.insert(out.end(), {loading.R_n, double(loading.path)});
  if (o.distribution == Distribution::von_mises && o.sampling != Sampling::list)
    out.insert(out.end(), {o.mean, o.concentration});
  if (o.sampling == Sampling::lattice) out.insert(out.end(), {p.L_y, double(o.seed), double(o.rows)});
  if (const SiScales scales = si_scales(point); !si.empty())
    out.insert(out.end(), {scales.length, scales.velocity, scales.force});
  return out;
}

// The experiment with an axis for each column of the sample, from the least to the greatest value.
Experiment without_sample(const Experiment& e) {
  Experiment out = e;
  out.axes.clear();
  for (const Axis& axis : e.axes) {
    if (axis.columns.empty()) out.axes.push_back(axis);
    for (const Axis& column : axis.columns) {
      const auto [least, greatest] = std::ranges::minmax(column.values);
      out.axes.push_back({column.name, {least, greatest}});
    }
  }
  return out;
}

// The experiment with only the first and the last value of this axis, all words of choices, and the first
// value of each other axis.
Experiment ends_of(const Experiment& e, std::size_t axis) {
  Experiment out = e;
  for (std::size_t d = 0; d < out.axes.size(); ++d) {
    std::vector<double>& values = out.axes[d].values;
    if (d == axis) values = {values.front(), values.back()};
    else if (out.axes[d].quantity().options.empty()) values.resize(1);
  }
  // The axis varies fastest, so that its two values are neighbours.
  std::rotate(out.axes.begin() + long(axis), out.axes.begin() + long(axis) + 1, out.axes.end());
  return out;
}

}  // namespace

bool same_effect(const PointInput& a, const PointInput& b) {
  return effective_input(a) == effective_input(b);
}

std::vector<std::string> axes_without_effect(const Experiment& with_sample) {
  const Experiment experiment = without_sample(with_sample);
  std::vector<std::string> out;
  for (std::size_t axis = 0; axis < experiment.axes.size(); ++axis) {
    const auto [least, greatest] = std::ranges::minmax(experiment.axes[axis].values);
    if (least == greatest) continue;
    const Experiment ends = ends_of(experiment, axis);
    bool differ = false;
    for (std::size_t i = 0; i < ends.points() && !differ; i += 2)
      differ = !same_effect(ends.point(i), ends.point(i + 1));
    if (!differ) out.push_back(experiment.axes[axis].name);
  }
  return out;
}

}  // namespace bristle::experiment
