#include "design/drawing.hpp"

#include "bristle/ensemble/phase.hpp"
#include "results/phases.hpp"
#include "sampling/rounded.hpp"
#include "sweep/si.hpp"
#include "util/text.hpp"
#include "util/units.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

namespace bristle::design {
namespace {

constexpr double kMillimetres = 1e3, kDegrees = 180 / M_PI;

// Returns the tolerance with which 99 % of the brushes, or more, stay on this side of the jumps if all else
// is as drawn: the greatest deviation if the dimension has one, otherwise a standard deviation. NaN: no jump
double band_of(const Dimension& dimension) {
  constexpr double beyond_one = 2.3263, beyond_either = 2.5758;  // standard deviations that 1 % exceed
  const double nearest = std::fmin(dimension.below, dimension.above);
  if (!std::isnan(dimension.tolerance) && !dimension.normal) return nearest;
  return nearest / (std::isnan(dimension.below + dimension.above) ? beyond_one : beyond_either);
}

// Returns the dimension with the tolerance and the margins of the quantity that determines it, in SI units or
// without.
Dimension dimension_of(const Trials& trials, const Findings& found, const std::string& quantity,
                       Dimension dimension) {
  const std::string label = label_of(quantity);
  for (const experiment::Tolerance& t : trials.design().tolerances)
    if (label_of(t.name) == label) {
      dimension.tolerance = t.width;
      dimension.normal = t.normal;
    }
  for (const Profile& profile : found.profiles)
    if (label_of(profile.quantity) == label) {
      dimension.below = profile.margin_below;
      dimension.above = profile.margin_above;
    }
  dimension.band = band_of(dimension);
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
  std::vector<Dimension> out;
  std::vector<std::string> drawn;
  const auto add = [&](const std::string& quantity, const std::string& name, const std::string& meaning,
                       const std::string& units, double value) {
    drawn.push_back(label_of(quantity));
    out.push_back(dimension_of(trials, found, quantity,
                               {name, meaning, units, value, kNone, false, kNone, kNone, kNone}));
  };
  add("r0_m", "length", "length of a bristle", "mm", mm);
  add("R_m", "diameter", "diameter of its shaft", "mm", 2 * p.R * mm);
  add("phi_0_deg", "angle", "angle between bristle and base", "degree", p.phi_0 * kDegrees);
  add("R_c_m", "tip_radius", "radius of its tip", "mm", p.R_c * mm);
  add("spacing_m", "spacing", "distance of neighbouring bristles", "mm", p.spacing * mm);
  out.push_back({"density", "bristles per area", "m-2", rounded(per_metre * per_metre), kNone, false, kNone,
                 kNone, kNone});
  for (const std::string& quantity : trials.design().quantities())
    if (std::ranges::count(drawn, label_of(quantity)) == 0) {
      const results::Column column = column_of(quantity);
      add(quantity, label_of(quantity), column.long_name, column.units,
          recommended(found).nominal.at(quantity));
    }
  return out;
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
  // Adds a column of texts as words of a choice, which have no spaces.
  const auto add_words = [&](const char* name, const char* about, const auto& text) {
    std::vector<std::string> words, texts;
    for (const Dimension& one : dimensions) {
      texts.push_back(text(one));
      std::ranges::replace(texts.back(), ' ', '_');
      if (texts.back().empty()) texts.back() = "1";
      if (std::ranges::count(words, texts.back()) == 0) words.push_back(texts.back());
    }
    out.add({name, about, "", "", results::Number::code, words, ""},
            [&](std::size_t row) { return std::ranges::find(words, texts[row]) - words.begin(); });
  };
  add_words("unit", "unit of the value", [](const Dimension& one) { return one.units; });
  const auto unit_of = [](const Dimension& one) { return readable_unit(one.units, one.value); };
  add_words("meaning", "meaning of the dimension", [](const Dimension& one) { return one.meaning; });
  out.add({"shown", "value in the unit for people", "", ""},
          [&](std::size_t row) { return dimensions[row].value / unit_of(dimensions[row]).size; });
  add_words("shown_unit", "unit for people", [&](const Dimension& one) { return unit_of(one).name; });
  add("tolerance", "tolerance, relative; NaN: none", &Dimension::tolerance);
  out.add({"tolerance_is", "what the tolerance is", "", "", results::Number::code, kTolerances, ""},
          [&](std::size_t row) { return tolerance_code(dimensions[row]); });
  add("margin_below", "relative decrease that reaches a jump of the gap; NaN: none in the range",
      &Dimension::below);
  add("margin_above", "relative increase that reaches a jump of the gap; NaN: none in the range",
      &Dimension::above);
  add("band",
      "tolerance, relative, with which 99 % of the brushes stay on this side of the jumps; NaN: no jump",
      &Dimension::band);
  return out;
}

std::vector<Working> working_range(const Sweep& sweep, const std::vector<results::PointRecord>& points) {
  std::vector<Working> out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto value = [&](const char* name) {
      return points[i].layout->has(name) ? points[i].at(name) : kNone;
    };
    out.push_back({sweep::si_scales(sweep.point(i)).velocity, value("R_n_in_N"), value("phase"),
                   value("load_over_lift_off")});
  }
  return out;
}

results::Dataset working_range_group(const std::vector<Working>& range) {
  results::Dataset out("working_range");
  out.add_dimension(results::row_numbers("scenario", "scenario of the recommended brush", range.size()));
  const auto add = [&](const char* name, const char* meaning, const char* units, double Working::*member) {
    out.add({name, meaning, "", units}, [&](std::size_t row) { return range[row].*member; });
  };
  add("velocity", "velocity of the slab", "m s-1", &Working::velocity);
  add("load", "load of a bristle", "N", &Working::load);
  const Words phases = words<BrushPhase>();
  out.add({"phase", "whether tips stay on the slab or bounce", "", "", results::Number::code,
           std::vector<std::string>(phases.begin(), phases.end()), ""},
          [&](std::size_t row) { return range[row].phase; });
  add("load_over_lift_off", "load over the lift-off load by the formula; NaN: not known", "1",
      &Working::load_over_lift_off);
  return out;
}

std::string working_range_text(const std::vector<Working>& range) {
  std::string out;
  for (const Working& one : range) {
    out += fmt::format("  at {:.3g} m/s under {:.3g} N: {}", one.velocity, one.load,
                       results::name_of(BrushPhase(std::lround(one.phase))));
    if (!std::isnan(one.load_over_lift_off))
      out += fmt::format(", {:.0f} % of its lift-off load", 100 * one.load_over_lift_off);
    out += "\n";
  }
  return out;
}

std::string drawing_text(const std::vector<Dimension>& dimensions, const Orientation& orientation) {
  std::vector<std::vector<std::string>> rows = {{"drawing", "size", "tolerance"}};
  const bool jump = std::ranges::any_of(dimensions, [](const Dimension& d) { return !std::isnan(d.band); });
  if (jump) rows.front().insert(rows.front().end(), {"the gap jumps at", "99 % stay with"});
  bool deviates = false;
  for (const Dimension& one : dimensions) {
    const ReadableUnit unit = readable_unit(one.units, one.value);
    const std::string units = unit.name.empty() ? "" : " " + unit.name;
    const auto size = [&](double value) { return fmt::format("{:.4g}{}", value / unit.size, units); };
    const auto tolerance = [&](double relative) {
      if (std::isnan(relative)) return std::string();
      const bool greatest = !std::isnan(one.tolerance) && !one.normal;
      deviates = deviates || !greatest;
      return fmt::format("{} {:.2g}{}", greatest ? "+-" : "s.d.", relative * std::abs(one.value) / unit.size,
                         units);
    };
    std::vector<std::string> jumps;
    if (!std::isnan(one.below)) jumps.push_back(size(one.value * (1 - one.below)));
    if (!std::isnan(one.above)) jumps.push_back(size(one.value * (1 + one.above)));
    rows.push_back({one.meaning, size(one.value), tolerance(one.tolerance),
                    fmt::format("{}", fmt::join(jumps, ", ")), tolerance(one.band)});
  }
  std::string out = aligned(rows);
  if (jump)
    out +=
        "  99 % stay with: tolerance of this dimension alone with which 99 % of the brushes stay on "
        "this side of the jump\n";
  if (deviates) out += "  s.d.: standard deviation\n";
  return out + fmt::format("  on a square lattice; bristles lean {}\n", orientation_text(orientation));
}

}  // namespace bristle::design
