#include "experiment/sample.hpp"

#include "bristle/model/elementary.hpp"
#include "experiment/values.hpp"
#include "json/node.hpp"
#include "bristle/ensemble/normal_quantile.hpp"
#include "sampling/rounded.hpp"
#include "sampling/sensitivity.hpp"
#include "bristle/ensemble/sobol.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace bristle::experiment {
namespace {

using json::Node;
using sweep::Axis, sweep::Sweepable;

// Returns true for the text of a number beyond the largest one, such as 1e999.
bool is_beyond_the_largest(const Json& value) {
  if (!value.is_string() || value.get<std::string>().find_first_of("0123456789") == std::string::npos)
    return false;
  const auto number = number_in(value);
  return number && std::isinf(*number);
}

// Returns the number, or the index of the word, that a cell or a list has for a quantity. place: function
// that returns the node of the value, for messages
template <class Place>
double value_of(const Sweepable& sweepable, const Json& value, Place place) {
  if (!sweepable.options.empty()) {
    const auto found =
        std::ranges::find(sweepable.options, value.is_string() ? value.get_ref<const std::string&>() : "");
    return found == sweepable.options.end() ? option_index(place(), sweepable, value)
                                            : double(found - sweepable.options.begin());
  }
  if (is_beyond_the_largest(value))
    place().fail(fmt::format("{} is beyond the largest number, 1.8e308", value.get<std::string>()));
  if (!value.is_number() || !std::isfinite(value.get<double>()))
    place().fail(fmt::format("{} is not a number, which {} needs", shown(value), sweepable.name));
  return value;
}

// Returns the values of a column of a table in all rows.
std::vector<double> values_of_column(const Node& table, std::size_t column, const Sweepable& sweepable) {
  const Node rows = table["rows"];
  const std::size_t columns = table["columns"].value().size();
  std::vector<double> values;
  for (std::size_t i = 0; i < rows.value().size(); ++i) {
    const Json& row = rows.value()[i];
    if (column >= row.size())
      rows[i].fail(fmt::format("has {} values, and the table has {} columns", row.size(), columns));
    values.push_back(value_of(sweepable, row[column], [&] { return rows[i][column]; }));
  }
  check_values(sweepable.name, values, [&](std::size_t i) { return rows[i][column]; });
  return values;
}

// Returns the indices of the rows that the sample takes.
std::vector<std::size_t> taken_rows(const Node& sample) {
  const std::size_t rows = sample["table"]["rows"].value().size();
  std::vector<std::size_t> taken(rows);
  std::iota(taken.begin(), taken.end(), 0);
  if (!sample.has("take")) return taken;
  taken = sample["take"].as<std::vector<std::size_t>>();
  for (std::size_t i = 0; i < taken.size(); ++i)
    if (taken[i] >= rows || (i > 0 && taken[i] <= taken[i - 1]))
      sample["take"].fail(
          fmt::format("{} is not allowed; allowed: ascending indices from 0 to {}", taken[i], rows - 1));
  return taken;
}

std::vector<Axis> columns_of_table(const Node& sample) {
  const Node table = sample["table"];
  std::vector<Axis> columns;
  for (const Node& place : table["columns"].elements()) {
    const std::string name = place.as<std::string>();
    const Sweepable& sweepable = require_sweepable(place, name);
    if (varies(columns, name)) place.fail(name + " appears twice");
    columns.push_back({name, values_of_column(table, columns.size(), sweepable), {}});
  }
  const std::vector<std::size_t> taken = taken_rows(sample);
  for (Axis& column : columns) {
    std::vector<double> values;
    for (const std::size_t i : taken) values.push_back(column.values[i]);
    column.values = values;
  }
  return columns;
}

// Returns the function that gives the value below which a share of the distribution lies. count: number of
// points, which must differ
std::function<double(double)> quantile_of(const Node& place, const Sweepable& sweepable, std::size_t count) {
  if (place.value().size() != 1)
    place.fail(fmt::format("{} gives {} distributions; one is needed: uniform, log, normal or values",
                           shown(place.value()), place.value().size()));
  const auto [kind, given] = place.members().front();
  if (kind == "values") {
    std::vector<double> values;
    for (const Node& value : given.elements())
      values.push_back(value_of(sweepable, value.value(), [&, at = given] { return at; }));
    return [values](double share) { return values[std::size_t(share * double(values.size()))]; };
  }
  if (!sweepable.options.empty())
    given.fail(fmt::format("{} is a choice; it needs \"values\", a list of words; allowed: {}",
                           sweepable.name, fmt::join(sweepable.options, ", ")));
  const double first = given[0].as<double>(), second = given[1].as<double>();
  if (kind == "normal") {
    if (!(second > 0)) given.fail(fmt::format("the standard deviation {} is not positive", second));
    require_distinct(given, first - second, first + second, count);
    return [=](double share) { return rounded(first + second * normal_quantile(share)); };
  }
  if (!(first < second))
    given.fail(
        fmt::format("{} is not below {}; {}", first, second, first == second ? "give a range" : "swap them"));
  require_distinct(given, first, second, count);
  if (kind == "uniform") return [=](double share) { return rounded(first + (second - first) * share); };
  if (!(first > 0))
    given.fail(fmt::format("a logarithmic distribution cannot begin at {}; allowed: greater than 0", first));
  return [=](double share) { return rounded(first * pow(second / first, share)); };
}

// Returns the columns of a sample by sobol. has_indices: whether the sample is the design for Sobol indices
std::vector<Axis> columns_of_distributions(const Node& sample, bool has_indices) {
  const auto over = sample["over"].members();
  const std::size_t count = sample["sobol"].as<std::size_t>();
  const std::uint64_t seed = sample["seed"].as<std::uint64_t>();
  const auto points =
      has_indices ? saltelli_design(count, over.size(), seed) : sobol_points(count, over.size(), seed);
  std::vector<Axis> columns;
  for (const auto& [name, place] : over) {
    const auto quantile = quantile_of(place, require_sweepable(place, name), count);
    Axis column{name, {}, {}};
    for (const auto& point : points) column.values.push_back(quantile(point[columns.size()]));
    check_values(name, column.values, [at = place](std::size_t) { return at; });
    columns.push_back(std::move(column));
  }
  return columns;
}

}  // namespace

Axis read_sample(const json::Document& document) {
  const Node sample(document, "/sweep/sample");
  const bool table = sample.has("table");
  if (table == sample.has("sobol"))
    sample.fail(
        fmt::format("needs exactly one of table and sobol; {} given", table ? "both are" : "neither is"));
  for (const char* key : {"seed", "over"})
    if (table == sample.has(key))
      sample[key].fail(table ? "is allowed with sobol only" : "is missing; a sample by sobol needs it");
  if (!table && sample.has("take"))
    sample["take"].fail("is allowed with table only; a smaller number for sobol takes the first points");
  const Node indices(document, "/analysis/sobol_indices");
  const bool has_indices = indices.exists() && !indices.value().empty();
  Axis axis{
      sweep::kSample, {}, table ? columns_of_table(sample) : columns_of_distributions(sample, has_indices)};
  axis.values.resize(axis.columns.front().values.size());
  std::iota(axis.values.begin(), axis.values.end(), 0.0);
  return axis;
}

}  // namespace bristle::experiment
