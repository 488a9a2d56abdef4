#include "checks/comparison.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <sstream>

namespace bristle {
namespace {

H5T_class_t class_of(hid_t dataset) {
  const h5::Handle type(H5Dget_type(dataset), H5Tclose, "reading a dataset's type");
  return H5Tget_class(type);
}

void collect(hid_t group, const std::string& prefix, std::vector<std::string>& names) {
  for (const std::string& name : h5::children(group)) {
    const std::string path = prefix + name;
    if (path == "checks" || path == "provenance") continue;
    if (h5::is_group(group, name)) {
      const h5::Handle child(H5Gopen2(group, name.c_str(), H5P_DEFAULT), H5Gclose, "opening " + path);
      collect(child, path + "/", names);
      continue;
    }
    const H5T_class_t kind = class_of(h5::open_dataset(group, name));
    if (kind == H5T_FLOAT || kind == H5T_INTEGER) names.push_back(path);
  }
}

// A dimension's coordinates lie beside the variable or, as the sweep's axes, in the root.
std::string coordinate(const ResultReader& result, const std::string& folder, const std::string& axis,
                       std::size_t i) {
  if (axis.empty()) return fmt::format("row {}", i);
  const std::string name = h5::exists(result.file(), folder + axis) ? folder + axis : axis;
  if (!h5::exists(result.file(), name)) return fmt::format("{}[{}]", axis, i);
  const auto values = result.variable(name).values;
  if (i >= values.size()) return fmt::format("{}[{}]", axis, i);
  const double value = values[i];
  const std::string text = value_text(result, name, value);
  return fmt::format("{} = {}", axis, text == fmt::format("{}", value) ? fmt::format("{:.6g}", value) : text);
}

}  // namespace

std::vector<std::string> numeric_datasets(const ResultReader& result) {
  std::vector<std::string> names;
  collect(result.file(), "", names);
  return names;
}

Kind kind_of(const ResultReader& result, const std::string& name) {
  const h5::Handle dataset = h5::open_dataset(result.file(), name);
  if (h5::is_scale(dataset)) return Kind::axis;
  if (class_of(dataset) != H5T_INTEGER) return Kind::real;
  return h5::has_attribute(dataset, "flag_meanings") ? Kind::flags : Kind::integer;
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
  const h5::Handle dataset = h5::open_dataset(result.file(), name);
  if (h5::has_attribute(dataset, "flag_meanings")) {
    std::istringstream meanings(h5::read_text_attribute(dataset, "flag_meanings"));
    std::string word;
    for (double code = 0; meanings >> word; ++code)
      if (code == value) return word;
  }
  return fmt::format("{}", value);
}

bool same_bits(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  return a == b && std::signbit(a) == std::signbit(b);
}

std::size_t ravel(const std::vector<std::size_t>& at, const std::vector<std::size_t>& shape) {
  std::size_t index = 0;
  for (std::size_t d = 0; d < shape.size(); ++d) index = index * shape[d] + at[d];
  return index;
}

std::vector<std::size_t> unravel(std::size_t index, const std::vector<std::size_t>& shape) {
  std::vector<std::size_t> at(shape.size());
  for (std::size_t d = shape.size(); d-- > 0; index /= shape[d]) at[d] = index % shape[d];
  return at;
}

std::string shell_quoted(const std::string& text) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || std::strchr("_./=:-", c);
  };
  if (!text.empty() && std::all_of(text.begin(), text.end(), plain)) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace bristle
