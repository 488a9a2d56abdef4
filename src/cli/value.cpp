#include "cli/commands.hpp"

#include "results/csv.hpp"
#include "util/error.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace bristle::cli {
namespace {

using results::Array;
using results::Dataset;

// Returns the column of a table. Throws InputError with the names that are allowed.
const Array& column_of(const Dataset& table, const std::string& name, const std::vector<std::string>& allowed,
                       const char* what) {
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

// Returns a number with its error, which may be NaN, and its units.
std::string number_text(double value, double error, const std::string& units) {
  if (std::isnan(value)) return "no value";
  const std::string unit = units.empty() || units == "1" ? "" : " " + units;
  const std::string digits = fmt::format("{:.{}g}", value, digits_left(value, error, 6));
  return std::isnan(error) ? digits + unit : fmt::format("{} +- {:.2g}{}", digits, error, unit);
}

std::string value_text(const Dataset& table, const Array& array, std::size_t row) {
  if (!array.about.words.empty()) return array.cell(row);
  return number_text(array.values[row], error_of(table, array, row), array.about.units);
}

// Returns a word, or {"value", "error", "units"} with null for a value or an error that is missing.
Json value_json(const Dataset& table, const Array& array, std::size_t row) {
  if (!array.about.words.empty()) return array.cell(row);
  return {{"value", array.values[row]},
          {"error", error_of(table, array, row)},
          {"units", array.about.units.empty() ? "1" : array.about.units}};
}

// Returns the names of the coordinates by which a reader knows a point: the number of a row tells nothing.
std::vector<std::string> places_of(const results::ResultReader& result) {
  std::vector<std::string> names = result.coordinates();
  std::erase(names, sweep::kSample);
  return names;
}

// Returns the words and numbers that place a point. names: of the coordinates
std::vector<std::string> place_of(const Dataset& table, const std::vector<std::string>& names,
                                  std::size_t row) {
  std::vector<std::string> place;
  for (const std::string& name : names) place.push_back(table.array(name).cell(row));
  return place;
}

// Returns the values of columns in a row, such as "k_r = 20, friction = nss".
std::string values_text(const Dataset& table, const std::vector<std::string>& names, std::size_t row) {
  std::vector<std::string> values;
  for (const std::string& name : names)
    values.push_back(fmt::format("{} = {}", name, value_text(table, table.array(name), row)));
  return fmt::format("{}", fmt::join(values, ", "));
}

// Returns the rows of two tables that have the same place, in the order of the first.
std::vector<std::pair<std::size_t, std::size_t>> rows_of_both(const Dataset& a, const Dataset& b,
                                                              const std::vector<std::string>& names) {
  std::multimap<std::vector<std::string>, std::size_t> rows_b;
  for (std::size_t row = 0; row < b.size(); ++row) rows_b.emplace(place_of(b, names, row), row);
  std::vector<std::pair<std::size_t, std::size_t>> both;
  for (std::size_t row = 0; row < a.size(); ++row)
    if (const auto found = rows_b.find(place_of(a, names, row)); found != rows_b.end()) {
      both.emplace_back(row, found->second);
      rows_b.erase(found);
    }
  return both;
}

// The columns of a row: the place, the values in A and in B, and the value in B minus the value in A.
using Row = std::array<std::string, 4>;

std::string in_columns(const std::vector<Row>& rows) {
  std::array<std::size_t, 4> widths{};
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string text;
  for (const Row& row : rows)
    text += fmt::format("{:<{}}  {:<{}}  {:<{}}  {}\n", row[0], widths[0], row[1], widths[1], row[2],
                        widths[2], row[3]);
  return text;
}

bool agree(double a, double b, const compare::Tolerances& tolerances) {
  return results::same_bits(a, b) ||
         (tolerances.given() &&
          std::abs(a - b) <=
              tolerances.atol.value_or(0) + tolerances.rtol.value_or(0) * std::max(std::abs(a), std::abs(b)));
}

}  // namespace

int print_side_by_side(const results::ResultReader& a, const results::ResultReader& b,
                       const DiffOptions& options) {
  const Dataset in_a = results::table_of(a, ""), in_b = results::table_of(b, "");
  require_variables(in_a, options.only, a.path());
  require_variables(in_b, options.only, b.path());
  const std::vector<std::string> names = places_of(a), names_b = places_of(b);
  if (std::set(names.begin(), names.end()) != std::set(names_b.begin(), names_b.end()))
    throw InputError(fmt::format(
        "--only: the axes of {} are {}, and of {} they are {}; allowed: results with the same axes", a.path(),
        fmt::join(names, ", "), b.path(), fmt::join(names_b, ", ")));
  const auto both = rows_of_both(in_a, in_b, names);
  std::size_t differ = 0;
  for (const std::string& name : options.only) {
    const Array &x = in_a.array(name), &y = in_b.array(name);
    const bool words = !x.about.words.empty();
    std::vector<Row> rows = {{name, "A", "B", "B - A"}};
    for (const auto& [i, j] : both) {
      const bool same = words ? x.cell(i) == y.cell(j) : agree(x.values[i], y.values[j], options.tolerances);
      differ += !same;
      const double error = std::fmax(error_of(in_a, x, i), 0) + std::fmax(error_of(in_b, y, j), 0);
      rows.push_back(
          {values_text(in_a, names, i), value_text(in_a, x, i), value_text(in_b, y, j),
           words ? (same ? "" : "differs") : number_text(y.values[j] - x.values[i], error, x.about.units)});
    }
    fmt::print("{}\n", in_columns(rows));
  }
  fmt::print("A: {}, B: {}: {} of {} values differ{}", a.path(), b.path(), differ,
             both.size() * options.only.size(),
             options.tolerances.given() ? " by more than the tolerance" : "");
  for (const auto& [table, result] : {std::pair(&in_a, &a), std::pair(&in_b, &b)})
    if (table->size() > both.size())
      fmt::print("; {} points are in {} alone", table->size() - both.size(), result->path());
  fmt::print("\n");
  return differ == 0 && both.size() == std::max(in_a.size(), in_b.size()) ? kSuccess : kCheckFailed;
}

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
    const std::string place = values_text(table, places_of(result), row);
    fmt::print("{}{}{}: {}\n", values_text(table, options.names, row), place.empty() ? "" : " at ", place,
               table.array("status").cell(row));
  }
  if (options.json) fmt::print("{}\n", out.dump(2));
  return kSuccess;
}

}  // namespace bristle::cli
