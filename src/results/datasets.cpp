#include "results/datasets.hpp"

#include "results/digest.hpp"
#include "util/grid.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

namespace bristle::results {
namespace {

// The coordinate at index i of a dimension. Coordinates are datasets in the folder of the variable or, for
// the axes of the sweep, in the root.
std::string coordinate(const ResultReader& result, const std::string& folder, const std::string& dimension,
                       std::size_t i) {
  if (dimension.empty()) return fmt::format("row {}", i);
  const std::string name = result.has(folder + dimension) ? folder + dimension : dimension;
  if (!result.has(name)) return fmt::format("{}[{}]", dimension, i);
  const auto values = result.variable(name).values;
  if (i >= values.size()) return fmt::format("{}[{}]", dimension, i);
  const double value = values[i];
  const std::string text = value_text(result, name, value);
  return fmt::format("{} = {}", dimension,
                     text == fmt::format("{}", value) ? fmt::format("{:.6g}", value) : text);
}

}  // namespace

std::vector<std::string> numeric_datasets(const ResultReader& result) {
  std::vector<std::string> names = payload_datasets(result.file());
  for (const std::string& name : std::vector(names))
    if (h5::is_text(h5::open_dataset(result.file(), name)) && std::erase(names, code_variable(name)) == 0)
      std::erase(names, name);
  return names;
}

DatasetKind kind_of(const ResultReader& result, const std::string& name) {
  const h5::Handle dataset = h5::open_dataset(result.file(), name);
  if (h5::is_scale(dataset)) return DatasetKind::coordinate;
  if (H5Tget_class(h5::type_of(dataset)) != H5T_INTEGER) return DatasetKind::real;
  return h5::has_attribute(dataset, "flag_meanings") ? DatasetKind::flags : DatasetKind::integer;
}

std::string place(const ResultReader& result, const std::string& name, std::size_t index) {
  const Variable v = result.variable(name);
  if (v.shape.empty()) return "the only point";
  const auto slash = name.rfind('/');
  const std::string folder = slash == std::string::npos ? "" : name.substr(0, slash + 1);
  const auto at = unravel(index, v.shape);
  std::vector<std::string> parts;
  for (std::size_t d = 0; d < at.size(); ++d)
    parts.push_back(coordinate(result, folder, v.dimensions[d], at[d]));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string value_text(const ResultReader& result, const std::string& name, double value) {
  const std::vector<std::string> words = result.flag_meanings(name);
  for (std::size_t code = 0; code < words.size(); ++code)
    if (double(code) == value) return words[code];
  return fmt::format("{}", value);
}

bool same_bits(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  return a == b && std::signbit(a) == std::signbit(b);
}

}  // namespace bristle::results
