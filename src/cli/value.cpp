#include "cli/commands.hpp"

#include "results/csv.hpp"
#include "util/error.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

namespace bristle::cli {
namespace {

using results::Array;
using results::Dataset;

// Returns the column of a table. Throws InputError with the names that are allowed.
const Array& column_of(const Dataset& table, const std::string& name, const std::vector<std::string>& allowed,
                       const std::string& what) {
  if (std::ranges::find(allowed, name) != allowed.end()) return table.array(name);
  if (name.find('=') != name.npos)
    throw InputError(fmt::format("there is no {} {}; write --at {}", what, printable(name), printable(name)));
  throw InputError(fmt::format("there is no {} {}{}; {}", what, printable(name), did_you_mean(name, allowed),
                               allowed.size() > 12 ? "`bristle info` lists all"
                                                   : fmt::format("it has: {}", fmt::join(allowed, ", "))));
}

// Returns the value of an axis that is nearest to the wanted one: a number, or the code of a word.
double nearest(const Array& axis, const std::string& wanted) {
  if (!axis.about.words.empty()) {
    std::vector<std::string> words;  // of the axis, which need not have all words of its quantity
    for (const double code : std::set(axis.values.begin(), axis.values.end())) {
      words.push_back(axis.about.words.at(std::size_t(code)));
      if (words.back() == wanted) return code;
    }
    throw InputError(fmt::format("--at {}={}: {} has the words {}", axis.about.name, printable(wanted),
                                 axis.about.name, fmt::join(words, ", ")));
  }
  const auto number = number_in(wanted);
  if (!number)
    throw InputError(fmt::format("--at {}={}: is not a number", axis.about.name, printable(wanted)));
  const auto [least, greatest] = std::ranges::minmax(axis.values);
  const double margin = 1e-6 * std::max(std::abs(least), std::abs(greatest));
  if (!(least - margin <= *number && *number <= greatest + margin))
    throw InputError(fmt::format("--at {}={}: {} is from {:.6g} to {:.6g}", axis.about.name,
                                 printable(wanted), axis.about.name, least, greatest));
  return *std::ranges::min_element(axis.values, {}, [&](double value) { return std::abs(value - *number); });
}

// Returns for each row whether it is at the wanted place. at: "axis=value"
std::vector<bool> selected(const Dataset& table, const std::vector<std::string>& at,
                           const std::vector<std::string>& coordinates) {
  std::vector<bool> rows(table.size(), true);
  for (const std::string& one : at) {
    const std::size_t equals = one.find('=');
    if (equals == one.npos) throw InputError(fmt::format("--at {}: write --at k_r=20", printable(one)));
    std::string name = one.substr(0, equals);
    // A load that the sweep sets is an axis beside the load that was reached.
    if (std::ranges::find(coordinates, name + "_target") != coordinates.end()) name += "_target";
    const Array& axis = column_of(table, name, coordinates, "axis");
    const double value = nearest(axis, one.substr(equals + 1));
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = rows[i] && axis.values[i] == value;
  }
  return rows;
}

// Returns the error of a variable in a row; NaN if it has none.
double error_of(const Dataset& table, const Array& array, std::size_t row) {
  const auto error = std::ranges::find(table.arrays(), array.about.name + "_err",
                                       [](const Array& one) { return one.about.name; });
  return error == table.arrays().end() ? std::nan("") : error->values[row];
}

std::string value_text(const Dataset& table, const Array& array, std::size_t row) {
  if (!array.about.words.empty()) return array.cell(row);
  const double value = array.values[row], error = error_of(table, array, row);
  if (std::isnan(value)) return "no value";
  const std::string units =
      array.about.units.empty() || array.about.units == "1" ? "" : " " + array.about.units;
  const std::string digits = fmt::format("{:.{}g}", value, digits_left(value, error, 6));
  return std::isnan(error) ? digits + units : fmt::format("{} +- {:.2g}{}", digits, error, units);
}

// Returns a word, or {"value", "error", "units"} with null for a value or an error that is missing.
Json value_json(const Dataset& table, const Array& array, std::size_t row) {
  if (!array.about.words.empty()) return array.cell(row);
  return {{"value", array.values[row]},
          {"error", error_of(table, array, row)},
          {"units", array.about.units.empty() ? "1" : array.about.units}};
}

}  // namespace

int value_command(const ValueOptions& options) {
  const results::ResultReader result(options.file);
  result.require_intact();
  const Dataset table = results::table_of(result, "");
  const std::vector<std::string> coordinates = result.coordinates();
  std::vector<std::string> all;
  for (const Array& array : table.arrays()) all.push_back(array.about.name);
  const std::vector<bool> rows = selected(table, options.at, coordinates);
  if (std::ranges::none_of(rows, std::identity()))
    throw InputError(fmt::format("{0}: no point is at {1}; `bristle value {2} {3}` prints all points",
                                 options.file, fmt::join(options.at, ", "), shell_quoted(options.file),
                                 fmt::join(options.names, " ")));
  for (const std::string& name : options.names) column_of(table, name, all, "variable");
  Json out = Json::array();
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (!rows[row]) continue;
    if (options.json) {
      Json one = {{"status", table.array("status").cell(row)}};
      for (const std::string& name : coordinates) one[name] = value_json(table, table.array(name), row);
      for (const std::string& name : options.names) one[name] = value_json(table, table.array(name), row);
      out.push_back(std::move(one));
      continue;
    }
    std::vector<std::string> values, place;
    for (const std::string& name : options.names)
      values.push_back(fmt::format("{} = {}", name, value_text(table, table.array(name), row)));
    for (const std::string& name : coordinates)
      if (name != "sample")
        place.push_back(fmt::format("{} = {}", name, value_text(table, table.array(name), row)));
    fmt::print("{}{}{}: {}\n", fmt::join(values, ", "), place.empty() ? "" : " at ", fmt::join(place, ", "),
               table.array("status").cell(row));
  }
  if (options.json) fmt::print("{}\n", out.dump(2));
  return kSuccess;
}

}  // namespace bristle::cli
