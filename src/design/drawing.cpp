#include "design/drawing.hpp"

#include "bristle/ensemble/phase.hpp"
#include "sampling/rounded.hpp"
#include "sweep/si.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace bristle::design {
namespace {

constexpr double kMillimetres = 1e3, kDegrees = 180 / M_PI;

// Returns the dimension with the tolerance and the margins of the quantity that determines it.
Dimension dimension_of(const Trials& trials, const Findings& found, const std::string& quantity,
                       Dimension dimension) {
  for (const experiment::Tolerance& t : trials.design().tolerances)
    if (t.name == quantity) {
      dimension.tolerance = t.width;
      dimension.normal = t.normal;
    }
  for (const Profile& profile : found.profiles)
    if (profile.quantity == quantity) {
      dimension.below = profile.margin_below;
      dimension.above = profile.margin_above;
    }
  dimension.value = rounded(dimension.value);
  return dimension;
}

// What the tolerance of a dimension can be, in the order of the codes in the result.
const std::vector<std::string> kTolerances = {"none", "standard_deviation", "greatest_deviation"};
std::size_t tolerance_code(const Dimension& dimension) {
  return std::isnan(dimension.tolerance) ? 0 : dimension.normal ? 1 : 2;
}

std::string orientation_text(const Orientation& o) {
  if (o.distribution == Distribution::uniform) return "in all directions";
  return fmt::format("about {:.4g} degrees from the velocity of the slab (concentration {:.3g})",
                     o.mean * kDegrees, o.concentration);
}

}  // namespace

std::vector<Dimension> drawing(const Trials& trials, const Findings& found) {
  const sweep::PointInput point = trials.with_rows({recommended(found).nominal}).point(0);
  const Parameters& p = point.setup.parameters;
  if (point.si.empty()) return {};
  const double mm = sweep::si_scales(point).length * kMillimetres;
  const double per_metre = kMillimetres / (p.spacing * mm);
  const auto dimension = [&](const char* quantity, const char* name, const char* meaning, const char* units,
                             double value) {
    return dimension_of(trials, found, quantity, {name, meaning, units, value, kNone, false, kNone, kNone});
  };
  return {
      dimension("r0_m", "length", "length of a bristle", "mm", mm),
      dimension("R_m", "diameter", "diameter of its shaft", "mm", 2 * p.R * mm),
      dimension("phi_0_deg", "angle", "angle between bristle and base", "degree", p.phi_0 * kDegrees),
      dimension("R_c_m", "tip_radius", "radius of its tip", "mm", p.R_c * mm),
      dimension("spacing_m", "spacing", "distance of neighbouring bristles", "mm", p.spacing * mm),
      {"density", "bristles per area", "m-2", rounded(per_metre * per_metre), kNone, false, kNone, kNone},
  };
}

results::Dataset drawing_group(const std::vector<Dimension>& dimensions) {
  std::vector<std::string> names;
  for (const Dimension& one : dimensions) names.push_back(one.name);
  results::Dataset out("drawing");
  out.add_dimension(results::coordinates("dimension", "dimension of the recommended brush", names));
  const auto add = [&](const char* name, const char* meaning, double Dimension::*member) {
    out.add({name, meaning, "", ""}, [&](std::size_t row) { return dimensions[row].*member; });
  };
  add("value", "value in the unit beside it", &Dimension::value);
  std::vector<std::string> units;
  for (const Dimension& one : dimensions)
    if (std::ranges::find(units, one.units) == units.end()) units.push_back(one.units);
  out.add({"unit", "unit of the value", "", "", results::Number::code, units, ""},
          [&](std::size_t row) { return std::ranges::find(units, dimensions[row].units) - units.begin(); });
  add("tolerance", "tolerance, relative; NaN: none", &Dimension::tolerance);
  out.add({"tolerance_is", "what the tolerance is", "", "", results::Number::code, kTolerances, ""},
          [&](std::size_t row) { return tolerance_code(dimensions[row]); });
  add("margin_below", "relative decrease that reaches a jump of the gap; NaN: none in the range",
      &Dimension::below);
  add("margin_above", "relative increase that reaches a jump of the gap; NaN: none in the range",
      &Dimension::above);
  return out;
}

std::string working_range_text(const Sweep& sweep, const std::vector<results::PointRecord>& points) {
  std::string out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    // Bristles that lean one way have no lift-off load.
    const auto value = [&](const char* name) {
      return points[i].layout->has(name) ? points[i].at(name).front() : kNone;
    };
    const auto phase = BrushPhase(std::lround(value("phase")));
    out += fmt::format("  at {:.3g} m/s under {:.3g} N: {}", sweep::si_scales(sweep.point(i)).velocity,
                       value("R_n_in_N"), word(phase));
    if (const double ratio = value("load_over_lift_off"); !std::isnan(ratio))
      out += fmt::format(", {:.0f} % of its lift-off load", 100 * ratio);
    if (const double speed = value("lift_off_speed"); !std::isnan(speed))
      out += fmt::format("; by the formula its tips bounce above {:.2g} +- {:.1g} m/s", speed,
                         value("lift_off_speed_err"));
    out += "\n";
  }
  return out;
}

std::string drawing_text(const std::vector<Dimension>& dimensions, const Orientation& orientation) {
  std::string out = "drawing:\n";
  for (const Dimension& one : dimensions) {
    const std::string value =
        one.value >= 1e4 ? fmt::format("{:.0f}", one.value) : fmt::format("{:.4g}", one.value);
    out += fmt::format("  {:<36} {:>8} {}", one.meaning, value, one.units == "m-2" ? "per m^2" : one.units);
    if (!std::isnan(one.tolerance))
      out += fmt::format(", {} {:.2g} {}", one.normal ? "standard deviation" : "+-",
                         one.tolerance * one.value, one.units);
    std::string margins;
    if (!std::isnan(one.below)) margins = fmt::format("at {:.4g}", one.value * (1 - one.below));
    if (!std::isnan(one.above))
      margins += fmt::format("{}at {:.4g}", margins.empty() ? "" : " and ", one.value * (1 + one.above));
    if (!margins.empty()) out += fmt::format("; the gap jumps {} {}", margins, one.units);
    out += "\n";
  }
  return out + fmt::format("  on a square lattice; bristles lean {}\n", orientation_text(orientation));
}

}  // namespace bristle::design
