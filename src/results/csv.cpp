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
#include <numeric>

namespace bristle::results {
namespace {

constexpr const char* kStart = "# bristle export";

// A column of one cell for each value of the dataset: words for codes.
CsvColumn column_of(const ResultReader& result, const std::string& path) {
  return {path.substr(path.rfind('/') + 1), result.text_of(path, "units"), result.text_of(path, "long_name"),
          result.flag_meanings(path), result.variable(path).values};
}

// The column with the cells at these indices.
CsvColumn at(CsvColumn column, const std::vector<std::size_t>& indices) {
  std::vector<double> values;
  values.reserve(indices.size());
  for (const std::size_t i : indices) values.push_back(column.values.at(i));
  column.values = std::move(values);
  return column;
}

// The indices along one dimension of all values of an array.
std::vector<std::size_t> along(const std::vector<std::size_t>& shape, std::size_t dimension,
                               std::size_t values) {
  std::size_t stride = 1;
  for (std::size_t d = dimension + 1; d < shape.size(); ++d) stride *= shape[d];
  std::vector<std::size_t> indices(values);
  for (std::size_t i = 0; i < values; ++i) indices[i] = i / stride % shape[dimension];
  return indices;
}

// Paths of the datasets of a group that are no coordinates, by name.
std::vector<std::string> datasets_of(const ResultReader& result, const std::string& group) {
  std::vector<std::string> paths;
  const std::string folder = group.empty() ? "" : group + "/";
  const auto names = group.empty() ? result.variables() : h5::children(h5::open_group(result.file(), group));
  for (const std::string& name : names)
    if (kind_of(result, folder + name) != DatasetKind::coordinate) paths.push_back(folder + name);
  return paths;
}

void require_group(const ResultReader& result, const std::string& group) {
  std::vector<std::string> groups;
  for (const std::string& name : h5::children(result.file()))
    if (h5::is_group(result.file(), name) && !h5::children(h5::open_group(result.file(), name)).empty())
      groups.push_back(name);
  if (group.empty() || std::ranges::find(groups, group) != groups.end()) return;
  throw InputError(
      fmt::format("{}: there is no table {}{}; it has: {}", result.path(), group, did_you_mean(group, groups),
                  groups.empty() ? "none beside the variables" : fmt::format("{}", fmt::join(groups, ", "))));
}

// The coordinates along each dimension of the rows.
void add_coordinates(const ResultReader& result, const std::string& group, const Variable& like,
                     std::vector<CsvColumn>& columns) {
  for (std::size_t d = 0; d < like.shape.size(); ++d) {
    const std::string &name = like.dimensions[d], own = group + "/" + name;
    const CsvColumn axis = column_of(result, !group.empty() && result.has(own) ? own : name);
    const std::vector<std::size_t> indices = along(like.shape, d, like.values.size());
    columns.push_back(at(axis, indices));
    if (name == "sample")
      for (const std::string& quantity : result.sample_columns())
        columns.push_back(at(column_of(result, quantity), indices));
  }
}

// The coordinates of the point to which each row of a recorded table belongs.
void add_points(const ResultReader& result, const std::string& table, std::vector<CsvColumn>& columns) {
  const std::vector<std::size_t> shape = result.sweep_shape();
  const std::vector<double>& points = result.variable(table + "/point").values;
  const auto axes = result.axes();
  for (std::size_t d = 0; d < axes.size(); ++d) {
    std::vector<std::size_t> indices;
    for (const double point : points) indices.push_back(unravel(std::size_t(point), shape).at(d));
    columns.push_back(at(column_of(result, axes[d]), indices));
  }
}

// Removes the rows of nodes that a traced curve does not have.
void drop_absent(std::vector<CsvColumn>& columns) {
  const auto status = std::ranges::find(columns, "status", &CsvColumn::name);
  if (status == columns.end()) return;
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < status->values.size(); ++i)
    if (status->values[i] != double(PointStatus::absent)) kept.push_back(i);
  if (kept.size() == status->values.size()) return;
  for (CsvColumn& column : columns) column = at(std::move(column), kept);
}

// A cell that is no number but begins like a formula gets an apostrophe: spreadsheets would evaluate it.
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

std::string CsvColumn::cell(std::size_t row) const {
  return words.empty() ? csv_number(values.at(row)) : value_text(words, values.at(row));
}

CsvColumn text_column(const std::string& name, const std::string& meaning,
                      const std::vector<std::string>& texts) {
  CsvColumn column{name, "", meaning, texts, std::vector<double>(texts.size())};
  std::iota(column.values.begin(), column.values.end(), 0.0);
  return column;
}

std::vector<CsvColumn> csv_columns(const ResultReader& result, const std::string& group) {
  require_group(result, group);
  const std::vector<std::string> paths = datasets_of(result, group);
  const auto dimensions = [&](const std::string& path) { return result.variable(path).shape.size(); };
  const auto most = std::ranges::max_element(paths, {}, dimensions);
  const Variable& like = result.variable(group.empty() ? "status" : paths.empty() ? group : *most);
  std::vector<CsvColumn> columns;
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
    else if (const Variable& v = result.variable(path);
             v.shape == like.shape && v.dimensions == like.dimensions)
      columns.push_back(column_of(result, path));
  drop_absent(columns);
  return columns;
}

std::string csv_text(const ResultReader& result, const std::vector<CsvColumn>& columns) {
  std::string text =
      fmt::format("{}: {}\n# experiment {}, tier {}, payload_sha256 {}\n", kStart, result.text("title"),
                  result.text("name"), result.text("tier"), result.text("payload_sha256"));
  std::vector<std::string> names;
  for (const CsvColumn& column : columns) {
    names.push_back(quoted(column.name));
    text += fmt::format("# {}{}: {}\n", printable(column.name),
                        column.units.empty() ? "" : " [" + column.units + "]", column.meaning);
  }
  text += fmt::format("{}\n", fmt::join(names, ","));
  const std::size_t rows = columns.empty() ? 0 : columns.front().values.size();
  fmt::memory_buffer lines;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const double value = columns[c].values.at(i);
      if (!columns[c].words.empty())
        fmt::format_to(std::back_inserter(lines), "{}", quoted(columns[c].cell(i)));
      else if (!std::isnan(value)) fmt::format_to(std::back_inserter(lines), "{}", value);
      lines.push_back(c + 1 < columns.size() ? ',' : '\n');
    }
  return text.append(lines.data(), lines.size());
}

FileKind csv_kind() { return {"a table exported by bristle", kStart, {}}; }

}  // namespace bristle::results
