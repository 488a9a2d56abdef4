#include "experiment/experiment.hpp"

#include "bristle/model/elementary.hpp"
#include "experiment/sample.hpp"
#include "experiment/values.hpp"
#include "json/node.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

namespace bristle::experiment {
namespace {

using json::Node;
using sweep::Axis, sweep::Sweepable;

std::vector<double> listed_numbers(const Node& list) {
  std::vector<double> values;
  for (const Json& value : list.value()) {
    if (!value.is_number()) list.fail(fmt::format("{} is not a number", shown(value)));
    values.push_back(value);
  }
  return values;
}

// Returns the values of a range [from, to, count].
std::vector<double> values_of_range(const Node& range, bool logarithmic) {
  const double from = range[0].as<double>(), to = range[1].as<double>(), count = range[2].as<double>();
  if (count != std::floor(count) || count < 1)
    range[2].fail(fmt::format("the count {} is not a positive integer", count));
  if (count > kMaxPoints)
    range[2].fail(fmt::format("{} points; allowed: at most {:.0e} in the sweep", count, kMaxPoints));
  if (logarithmic && !(from > 0))
    range[0].fail(fmt::format("a logarithmic axis cannot start at {}; allowed: greater than 0", from));
  if (count > 1 && !(to > from))
    range[1].fail(fmt::format("a range must end above its start, {}, but {} does not", from, to));
  const auto n = std::size_t(count);
  std::vector<double> values(n, from);
  for (std::size_t i = 1; i < n; ++i) {
    const double share = double(i) / double(n - 1);
    values[i] = logarithmic
                    ? from * pow(to / from, share)
                    : from + (to - from) * double(i) / double(n - 1);  // exact for integers, unlike share
  }
  if (n > 1) values.back() = to;
  return values;
}

// Returns the values of an axis before "take" selects some of them.
std::vector<double> all_numbers(const Node& axis) {
  std::vector<std::string> given;
  for (const char* kind : {"values", "linspace", "logspace"})
    if (axis.has(kind)) given.emplace_back(kind);
  if (given.size() != 1)
    axis.fail(fmt::format("an axis needs exactly one of values, linspace, logspace; found {}",
                          given.empty() ? "none" : fmt::format("{}", fmt::join(given, " and "))));
  if (given[0] == "values") return listed_numbers(axis["values"]);
  return values_of_range(axis[given[0]], given[0] == "logspace");
}

// Returns the indices of the given words in the options of the choice.
std::vector<double> all_words(const Node& axis, const Sweepable& choice) {
  if (!axis.has("values") || axis.has("linspace") || axis.has("logspace"))
    axis.fail(fmt::format("{} needs \"values\" alone, a list of words; allowed: {}", choice.name,
                          fmt::join(choice.options, ", ")));
  const Node list = axis["values"];
  std::vector<double> indices;
  for (const Json& word : list.value()) {
    const double index = option_index(list, choice, word);
    if (std::ranges::count(indices, index)) list.fail(fmt::format("{} appears twice", shown(word)));
    indices.push_back(index);
  }
  return indices;
}

std::vector<double> taken(const Node& axis, const std::vector<double>& values) {
  if (!axis.has("take")) return values;
  const Node take = axis["take"];
  std::vector<double> kept;
  long last = -1;
  for (const long index : take.value()) {
    if (index <= last || index >= long(values.size()))
      take.fail(fmt::format("{} is not allowed; allowed: ascending indices from 0 to {}", index,
                            values.size() - 1));
    kept.push_back(values[std::size_t(index)]);
    last = index;
  }
  return kept;
}

Axis read_axis(const Node& axis, const std::string& name) {
  const Sweepable& sweepable = require_sweepable(axis, name);
  if (!sweepable.options.empty()) return {name, taken(axis, all_words(axis, sweepable))};
  const std::vector<double> values = all_numbers(axis);
  const auto place = [&](std::size_t) { return axis; };
  check_finite(name, values, place);
  for (std::size_t i = 1; i < values.size(); ++i)
    if (!(values[i] > values[i - 1]))
      axis.fail(fmt::format("the values must ascend, but {} follows {}", values[i], values[i - 1]));
  check_values(name, values, place);
  return {name, taken(axis, values)};
}

}  // namespace

std::vector<Axis> read_axes(const json::Document& document) {
  const Node sweep(document, "/sweep");
  std::vector<Axis> axes;
  double points = 1;
  for (const auto& [name, node] : sweep.members()) {
    axes.push_back(name == sweep::kSample ? read_sample(document) : read_axis(node, name));
    for (const Axis& column : axes.back().columns)
      if (sweep.has(column.name))
        node.fail(column.name + " is varied by another axis, too; remove one of them");
    points *= double(axes.back().values.size());
    if (points > kMaxPoints)
      sweep.fail(fmt::format("{:.3g} points or more; allowed: at most {:.0e}", points, kMaxPoints));
  }
  return axes;
}

}  // namespace bristle::experiment
