#include "sweep/sweep.hpp"

#include "sweep/si.hpp"
#include "bristle/model/friction/laws.hpp"
#include "bristle/model/material.hpp"
#include "util/grid.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace bristle::sweep {

const Sweepable& Axis::quantity() const {
  static const Sweepable sample = {kSample, kSample, "number of the point in the sample", "1", {}, {}};
  return columns.empty() ? *find_sweepable(name) : sample;
}

bool Axis::varies(const std::string& quantity) const {
  return name == quantity || sweep::varies(columns, quantity);
}

void Axis::set(PointInput& point, std::size_t index) const {
  if (columns.empty()) quantity().set(point, values[index]);
  for (const Axis& column : columns) column.set(point, index);
}

void Axis::keep_first() {
  values.resize(1);
  for (Axis& column : columns) column.keep_first();
}

bool varies(const std::vector<Axis>& axes, const std::string& quantity) {
  return std::ranges::any_of(axes, [&](const Axis& axis) { return axis.varies(quantity); });
}

void apply_nominal_friction(PointInput& point) {
  if (!point.nominal_friction) return;
  set_nominal_friction(point.setup.parameters, *point.nominal_friction, point.loading.R_n);
}

std::size_t Sweep::size() const { return grid_size(shape()); }

std::vector<std::size_t> Sweep::shape() const {
  std::vector<std::size_t> out;
  for (const Axis& axis : axes) out.push_back(axis.values.size());
  return out;
}

PointInput Sweep::point(std::size_t index) const {
  PointInput point = base;
  for (auto axis = axes.rbegin(); axis != axes.rend(); ++axis) {
    axis->set(point, index % axis->values.size());
    index /= axis->values.size();
  }
  apply_si_units(point);
  apply_nominal_friction(point);
  Parameters& p = point.setup.parameters;
  if (C_peaks_at_V_s) p.C = chi_C_peak_at_V_s(p.A);
  return point;
}

std::string Sweep::place(std::size_t index) const {
  const auto at = unravel(index, shape());
  std::string out;
  for (std::size_t d = 0; d < at.size(); ++d)
    out += fmt::format("{}{} = {}", d > 0 ? ", " : "", axes[d].name,
                       axes[d].quantity().text(axes[d].values[at[d]]));
  return out.empty() ? "the only point" : out;
}

bool Sweep::varies(const std::string& quantity) const { return sweep::varies(axes, quantity); }

bool Sweep::on_lattice() const {
  return base.setup.orientation.sampling == Sampling::lattice || varies("sampling");
}

std::size_t Sweep::axis_number(const std::string& name) const {
  return std::size_t(std::ranges::find(axes, name, &Axis::name) - axes.begin());
}

Sweep Sweep::with(Axis axis) const {
  Sweep out = *this;
  if (const std::size_t number = axis_number(axis.name); number < axes.size())
    out.axes[number] = std::move(axis);
  else out.axes.insert(out.axes.begin(), std::move(axis));
  return out;
}

Sweep Sweep::without(const std::string& name) const {
  Sweep out = *this;
  std::erase_if(out.axes, [&](const Axis& axis) { return axis.name == name; });
  return out;
}

Sweep Sweep::first_values(const std::vector<std::string>& except) const {
  Sweep out = *this;
  for (Axis& axis : out.axes)
    if (std::ranges::none_of(except, [&](const std::string& name) { return axis.varies(name); }))
      axis.keep_first();
  return out;
}

}  // namespace bristle::sweep
