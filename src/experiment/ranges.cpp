#include "experiment/ranges.hpp"

#include "bristle/model/elementary.hpp"
#include "experiment/schema.hpp"
#include "experiment/values.hpp"
#include "json/node.hpp"
#include "sampling/rounded.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

namespace bristle::experiment {
namespace {

using json::Node;
using sweep::Axis;

constexpr double kNoNominal = std::numeric_limits<double>::quiet_NaN();

// Returns the largest relative deviation: a normal one of a sample of a million is within five standard
// deviations.
double reach(const Tolerance& tolerance) { return tolerance.width * (tolerance.normal ? 5 : 1); }

// Throws InputError unless the name belongs to a real number that the sweep does not vary.
void require_number(const Node& place, const std::string& name) {
  if (!require_sweepable(place, name).options.empty())
    place.fail(name + " is a choice, not a number; put its words into the sweep as scenarios");
  if (parameter_schema(name).value("type", "") == "integer")
    place.fail(name +
               " is an integer, between whose values there is nothing; put its values into the sweep as "
               "scenarios");
  if (Node(place.document(), "/sweep").has(name))
    place.fail(name + " is varied by the sweep, too; remove one of them");
}

// Reads the range of a variable. budget: number of trials, whose values must differ
Range read_range(const Node& place, const std::string& name, std::size_t budget) {
  require_number(place, name);
  const bool log = place.value().is_object();
  const Node ends = log ? place["log"] : place;
  const Range range{name, ends[0].as<double>(), ends[1].as<double>(), log};
  if (!(range.low < range.high))
    place.fail(fmt::format("the lower bound {} is not below the upper bound {}; {}", range.low, range.high,
                           range.low == range.high ? "give a range, or remove the variable" : "swap them"));
  if (log && !(range.low > 0)) place.fail(fmt::format("a logarithmic range cannot begin at {}", range.low));
  require_distinct(place, range.low, range.high, budget);
  check_values(name, {range.low, range.high}, [&](std::size_t) { return place; });
  return range;
}

// Returns the value that the experiment gives for a quantity. tolerance: place of its tolerance
double nominal_value(const Node& tolerance, const std::string& name) {
  if (const auto value = own_value(tolerance.document(), name)) return *value;
  tolerance.fail(fmt::format("has no nominal value; give {}, or make it a variable", place_in_words(name)));
}

Tolerance read_tolerance(const Node& place, const std::string& name, bool is_variable) {
  require_number(place, name);
  const bool normal = place.has("normal");
  const Tolerance tolerance{name, normal, place.value().front(),
                            is_variable ? kNoNominal : nominal_value(place, name)};
  if (tolerance.nominal == 0)
    place.fail(
        fmt::format("deviates relative to {}, which is 0, so that every deviation is 0, too; remove it, or "
                    "give {} another value",
                    name, place_in_words(name)));
  if (reach(tolerance) >= 1)
    place.fail(fmt::format("{} is too wide: values could reach zero; allowed: less than {}", tolerance.width,
                           normal ? 0.2 : 1.0));
  return tolerance;
}

}  // namespace

std::optional<double> own_value(const json::Document& document, const std::string& name) {
  const Node at(document, pointer_to(name)->to_string());
  if (name.starts_with(sweep::kScatterPrefix)) return at.exists() ? at.value().front().get<double>() : 0;
  if (!at.exists() || !at.value().is_number()) return {};
  return at.as<double>();
}

double Range::at(double share) const {
  if (share <= 0 || share >= 1) return share <= 0 ? low : high;
  return rounded(log ? low * pow(high / low, share) : low + (high - low) * share);
}

std::vector<std::string> Ranges::quantities() const {
  std::vector<std::string> names;
  for (const Range& range : variables) names.push_back(range.name);
  for (const Tolerance& tolerance : tolerances)
    if (!std::isnan(tolerance.nominal)) names.push_back(tolerance.name);
  return names;
}

std::vector<std::string> Ranges::tolerated() const {
  std::vector<std::string> names;
  for (const Tolerance& tolerance : tolerances) names.push_back(tolerance.name);
  return names;
}

std::vector<Axis> Ranges::bounds() const {
  std::vector<Axis> columns;
  for (const Range& range : variables) columns.push_back({range.name, {range.low, range.high}});
  for (const Tolerance& tolerance : tolerances)
    if (const double nominal = tolerance.nominal; !std::isnan(nominal))
      columns.push_back({tolerance.name, {nominal * (1 - tolerance.width), nominal * (1 + tolerance.width)}});
  return columns;
}

std::vector<Axis> Ranges::extremes() const {
  std::vector<Axis> axes;
  for (const Range& range : variables) axes.push_back({range.name, {range.low, range.high}});
  for (const Tolerance& tolerance : tolerances) {
    const bool is_variable = std::ranges::count(axes, tolerance.name, &Axis::name) > 0;
    // The neighbours that a jump margin needs are within the bounds of a variable.
    const double change = is_variable ? reach(tolerance) : std::max(reach(tolerance), jump_margin);
    if (!is_variable) axes.push_back({tolerance.name, {tolerance.nominal, tolerance.nominal}});
    Axis& axis = *std::ranges::find(axes, tolerance.name, &Axis::name);
    const double low = axis.values.front(), high = axis.values.back();
    axis.values = {rounded(low * (1 - change)), rounded(low * (1 + change)), rounded(high * (1 - change)),
                   rounded(high * (1 + change))};
    const auto [least, greatest] = std::ranges::minmax(axis.values);
    axis.values = {least, greatest};
  }
  return axes;
}

Ranges read_ranges(const json::Document& document) {
  const Node design(document, "/design");
  Ranges ranges;
  if (!design.exists()) return ranges;
  for (const auto& [name, place] : design["variables"].members())
    ranges.variables.push_back(read_range(place, name, design["budget"].as<std::size_t>()));
  for (const auto& [name, place] : design["tolerances"].members())
    ranges.tolerances.push_back(
        read_tolerance(place, name, std::ranges::count(ranges.variables, name, &Range::name) > 0));
  for (const Node& constraint : design["constraints"].elements())
    ranges.jump_margin = std::max(ranges.jump_margin, constraint.get("jump_margin", 0.0));
  for (const Axis& extremes : ranges.extremes()) {
    const bool varied = std::ranges::count(ranges.tolerances, extremes.name, &Tolerance::name) > 0;
    check_values(extremes.name, extremes.values,
                 [&](std::size_t) { return design[varied ? "tolerances" : "variables"][extremes.name]; });
  }
  return ranges;
}

}  // namespace bristle::experiment
