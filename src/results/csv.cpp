#include "results/csv.hpp"

#include "util/error.hpp"
#include "util/grid.hpp"
#include "util/text.hpp"

#include <boost/algorithm/string/replace.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <iterator>

namespace bristle::results {
namespace {

constexpr const char* kStart = "# bristle export";

// Returns the values at these indices, as a column of a table.
Array at(Array column, const std::vector<std::size_t>& indices) {
  std::vector<double> values;
  values.reserve(indices.size());
  for (const std::size_t i : indices) values.push_back(column.values.at(i));
  column.values = std::move(values);
  return column;
}

// Returns the index along one dimension of each value of an array. values: number of values of the array
std::vector<std::size_t> along(const std::vector<std::size_t>& shape, std::size_t dimension,
                               std::size_t values) {
  std::size_t stride = 1;
  for (std::size_t d = dimension + 1; d < shape.size(); ++d) stride *= shape[d];
  std::vector<std::size_t> indices(values);
  for (std::size_t i = 0; i < values; ++i) indices[i] = i / stride % shape[dimension];
  return indices;
}

// Returns the paths of the datasets of a group that are not coordinates, by name.
std::vector<std::string> datasets_of(const ResultReader& result, const std::string& group) {
  std::vector<std::string> paths;
  const std::string folder = group.empty() ? "" : group + "/";
  for (const std::string& path : result.datasets())
    if (path.starts_with(folder) && path.find('/', folder.size()) == std::string::npos &&
        !result.variable(path).coordinate)
      paths.push_back(path);
  return paths;
}

void require_group(const ResultReader& result, const std::string& group) {
  std::vector<std::string> groups;
  for (const std::string& name : result.names(""))
    if (result.is_group(name) && !result.names(name).empty()) groups.push_back(name);
  if (group.empty() || std::ranges::find(groups, group) != groups.end()) return;
  throw InputError(
      fmt::format("{}: there is no table {}{}; it has: {}", result.path(), group, did_you_mean(group, groups),
                  groups.empty() ? "none beside the variables" : fmt::format("{}", fmt::join(groups, ", "))));
}

// Adds the coordinates of the rows along each dimension of `like`.
void add_coordinates(const ResultReader& result, const std::string& group, const Array& like,
                     std::vector<Array>& columns) {
  for (std::size_t d = 0; d < like.shape.size(); ++d) {
    const std::string &name = like.dimensions[d], own = group + "/" + name;
    const Array& axis = result.variable(!group.empty() && result.has(own) ? own : name);
    const std::vector<std::size_t> indices = along(like.shape, d, like.values.size());
    columns.push_back(at(axis, indices));
    if (name == "sample")
      for (const std::string& quantity : result.sample_columns())
        columns.push_back(at(result.variable(quantity), indices));
  }
}

// Adds the coordinates of the point to which each row of a recorded table belongs, except coordinates that
// the table has.
void add_points(const ResultReader& result, const std::string& table, std::vector<Array>& columns) {
  const std::vector<std::size_t> shape = result.sweep_shape();
  const std::vector<double>& points = result.variable(table + "/point").values;
  const auto axes = result.axes();
  for (std::size_t d = 0; d < axes.size(); ++d) {
    if (result.has(table + "/" + axes[d])) continue;
    std::vector<std::size_t> indices;
    for (const double point : points) indices.push_back(unravel(std::size_t(point), shape).at(d));
    columns.push_back(at(result.variable(axes[d]), indices));
  }
}

// Returns a cell, quoted if necessary. Text that begins like a formula gets an apostrophe, because
// spreadsheets would evaluate it.
std::string quoted(std::string cell) {
  double number = 0;
  const char* end = cell.data() + cell.size();
  const bool is_number = std::from_chars(cell.data(), end, number).ptr == end;
  if (!cell.empty() && !is_number && std::strchr("=+-@", cell.front())) cell.insert(0, "'");
  cell = printable(cell);
  if (cell.find_first_of(",\"#") == std::string::npos) return cell;
  return "\"" + boost::replace_all_copy(cell, "\"", "\"\"") + "\"";
}

}  // namespace

std::string csv_number(double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }

Dataset table_of(const ResultReader& result, const std::string& group) {
  require_group(result, group);
  const std::vector<std::string> paths = datasets_of(result, group);
  const auto dimensions = [&](const std::string& path) { return result.variable(path).shape.size(); };
  const auto most = std::ranges::max_element(paths, {}, dimensions);
  const Array& like = result.variable(group.empty() ? "status" : paths.empty() ? group : *most);
  std::vector<Array> columns;
  try {
    add_coordinates(result, group, like, columns);
    if (result.has(group + "/point")) add_points(result, group, columns);
  } catch (const std::out_of_range&) {
    throw InputError(fmt::format("{}: damaged: the rows of {} and the axes are inconsistent", result.path(),
                                 group.empty() ? "the variables" : group));
  }
  const auto sample = result.sample_columns();
  for (const std::string& path : paths)
    if (std::ranges::find(sample, path) != sample.end()) continue;
    else if (const Array& array = result.variable(path);
             array.shape == like.shape && array.dimensions == like.dimensions)
      columns.push_back(array);
  Dataset table;
  table.add_dimension(row_numbers("row", "row number", columns.empty() ? 0 : columns.front().values.size()));
  for (Array& column : columns) table.add(std::move(column));
  return table;
}

std::string csv_text(const ResultReader& result, const Dataset& table) {
  std::string text =
      fmt::format("{}: {}\n# experiment {}, tier {}, payload_sha256 {}\n", kStart, result.text("title"),
                  result.text("name"), result.text("tier"), result.text("payload_sha256"));
  std::vector<std::string> names;
  for (const auto& [about, dimensions, shape, values, coordinate] : table.arrays()) {
    names.push_back(quoted(about.name));
    text += fmt::format("# {}{}: {}\n", printable(about.name),
                        about.units.empty() ? "" : " [" + about.units + "]", about.long_name);
  }
  text += fmt::format("{}\n", fmt::join(names, ","));
  fmt::memory_buffer lines;
  for (std::size_t i = 0; i < table.size(); ++i)
    for (const Array& column : table.arrays()) {
      const double value = column.values.at(i);
      if (!column.about.words.empty())
        fmt::format_to(std::back_inserter(lines), "{}", quoted(column.cell(i)));
      else if (!std::isnan(value)) fmt::format_to(std::back_inserter(lines), "{}", value);
      lines.push_back(&column == &table.arrays().back() ? '\n' : ',');
    }
  return text.append(lines.data(), lines.size());
}

FileKind csv_kind() { return {"a table exported by bristle", kStart, {}}; }

}  // namespace bristle::results
