#include "sweep/sweep.hpp"
#include "sweep/si.hpp"
#include "bristle/model/equations.hpp"

#include <algorithm>

namespace bristle::sweep {
namespace {

// Returns all that a point's numbers depend on, beside what the points of an experiment have in common.
std::vector<double> effective_input(const PointInput& point) {
  // The strength of friction and the unit of its speeds are in the setup.
  const auto& [setup, loading, si, friction_law_in_si, nominal_friction] = point;
  Parameters p = setup.parameters;
  if (!has_pole(p.bending)) p.pole_rule = {};
  if (p.bending != Bending::rod) p.section = {};
  const Orientation& o = setup.orientation;
  constexpr double any_gap = 0.5, any_azimuth = 1;
  const Bristle<double> bristle = make_bristle(p, loading.z_0.value_or(any_gap), any_azimuth);
  std::vector<double> out = {
      p.L_x,           p.s_min,          p.spacing,         p.R_c, p.E_star, p.R, p.strain_limit,
      p.stretch_limit, p.pressure_limit, double(o.sampling)};
  for (const double* constant : constants_of(bristle)) out.push_back(*constant);
  for (const Choice& c : choices()) out.push_back(c.get(p));
  if (!loading.z_0) out.insert(out.end(), {loading.R_n, double(loading.path)});
  if (o.distribution == Distribution::von_mises && o.sampling != Sampling::list)
    out.insert(out.end(), {o.mean, o.concentration});
  if (o.sampling == Sampling::lattice) out.insert(out.end(), {p.L_y, double(o.seed), double(o.rows)});
  out.insert(out.end(), setup.scatter.width.begin(), setup.scatter.width.end());
  if (const SiScales scales = si_scales(point); !si.empty())
    out.insert(out.end(), {scales.length, scales.velocity, scales.force});
  return out;
}

// Returns the sweep with an axis for each column of the sample, from the least to the greatest value.
Sweep with_axes_for_columns(const Sweep& sweep) {
  Sweep out = sweep.without(kSample);
  for (const Axis& axis : sweep.axes)
    for (const Axis& column : axis.columns) {
      const auto [least, greatest] = std::ranges::minmax(column.values);
      out = out.with({column.name, {least, greatest}});
    }
  return out;
}

// Returns the sweep with only the first and the last value of this axis, which is the first of its axes, all
// words of choices, and the first value of each other axis.
Sweep ends_of(const Sweep& sweep, const Axis& axis) {
  std::vector<std::string> choices;
  for (const Axis& other : sweep.axes)
    if (!other.quantity().options.empty()) choices.push_back(other.name);
  return sweep.without(axis.name).first_values(choices).with(
      {axis.name, {axis.values.front(), axis.values.back()}});
}

}  // namespace

bool same_effect(const PointInput& a, const PointInput& b) {
  return effective_input(a) == effective_input(b);
}

std::vector<std::string> axes_without_effect(const Sweep& sweep) {
  const Sweep single = with_axes_for_columns(sweep);
  std::vector<std::string> out;
  for (const Axis& axis : single.axes) {
    const auto [least, greatest] = std::ranges::minmax(axis.values);
    if (least == greatest) continue;
    const Sweep ends = ends_of(single, axis);
    const std::size_t half = ends.size() / 2;  // the points at the first value
    bool differ = false;
    for (std::size_t i = 0; i < half && !differ; ++i)
      differ = !same_effect(ends.point(i), ends.point(half + i));
    if (!differ) out.push_back(axis.name);
  }
  return out;
}

}  // namespace bristle::sweep
