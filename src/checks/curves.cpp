#include "checks/curves.hpp"

#include "util/error.hpp"
#include "util/text.hpp"
#include "ensemble/trace.hpp"
#include "model/elementary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

namespace bristle {
namespace {

constexpr double kSameValue = 1e-9;  // relative, of an axis

// A variable with its errors over the sweep, and which points are selected.
struct Field {
  std::vector<std::string> dimensions;
  std::vector<std::size_t> shape;
  std::vector<double> values, errors;
  std::vector<bool> kept;
};

std::size_t stride_of(const Field& field, std::size_t dimension) {
  std::size_t stride = 1;
  for (std::size_t d = dimension + 1; d < field.shape.size(); ++d) stride *= field.shape[d];
  return stride;
}

std::size_t dimension_of(const ResultReader& result, const Field& field, const std::string& variable,
                         const std::string& name) {
  const auto found = std::find(field.dimensions.begin(), field.dimensions.end(), name);
  if (found == field.dimensions.end())
    throw InputError(fmt::format("{}: {} has no dimension {}{}; it has: {}", result.path(), variable, name,
                                 did_you_mean(name, field.dimensions), fmt::join(field.dimensions, ", ")));
  return std::size_t(found - field.dimensions.begin());
}

// Of a variable that has the value of each point, or of an axis each of the dimension.
std::vector<double> values_of(const ResultReader& result, const std::string& name, std::size_t count) {
  std::vector<double> values = result.variable(name).values;
  if (values.size() != count)
    throw InputError(
        fmt::format("{}: damaged: {} has {} values, not {}", result.path(), name, values.size(), count));
  return values;
}

Field read(const ResultReader& result, const std::string& name) {
  const Variable v = result.variable(name);
  Field field{v.dimensions, v.shape, v.values, std::vector<double>(v.values.size(), 0),
              std::vector<bool>(v.values.size(), true)};
  const auto known = result.variables();
  if (std::find(known.begin(), known.end(), name + "_err") != known.end())
    field.errors = values_of(result, name + "_err", field.values.size());
  return field;
}

void divide(const ResultReader& result, Field& field, const std::string& name, double power) {
  const Field by = read(result, name);
  if (by.shape != field.shape)
    throw InputError(fmt::format("{}: damaged: {} is of another shape", result.path(), name));
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    const double relative = std::abs(power) * by.errors[i] / std::abs(by.values[i]);
    field.values[i] /= pow(by.values[i], power);
    field.errors[i] = field.errors[i] / pow(by.values[i], power) + std::abs(field.values[i]) * relative;
  }
}

// The number that a selection's value stands for: itself, or the index of a word among a choice's options.
double number_of(const ResultReader& result, const std::string& name, const Json& value) {
  if (value.is_number()) return value;
  const auto words = result.flag_meanings(name);
  const auto found = std::find(words.begin(), words.end(), value.get<std::string>());
  if (found == words.end())
    throw InputError(fmt::format("{}: {} is not one of {}'s words: {}", result.path(), shown(value), name,
                                 fmt::join(words, ", ")));
  return double(found - words.begin());
}

void keep_on_axis(const ResultReader& result, Field& field, std::size_t d, const Json& wanted) {
  const std::string& name = field.dimensions[d];
  const std::vector<double> axis = values_of(result, name, field.shape[d]);
  const bool range = wanted.is_array();
  const double low = number_of(result, name, range ? wanted[0] : wanted);
  const double high = range ? number_of(result, name, wanted[1]) : low;
  const double slack = kSameValue * std::max(std::abs(low), std::abs(high));
  const auto selected = [&](double x) { return x >= low - slack && x <= high + slack; };
  if (std::none_of(axis.begin(), axis.end(), selected))
    throw InputError(fmt::format("{}: the axis {} has no value {}; it has: {:.6g}", result.path(), name,
                                 shown(wanted), fmt::join(axis, ", ")));
  const std::size_t stride = stride_of(field, d);
  for (std::size_t i = 0; i < field.kept.size(); ++i)
    if (!selected(axis[i / stride % field.shape[d]])) field.kept[i] = false;
}

void select(const ResultReader& result, Field& field, const Json& where) {
  for (const auto& [name, wanted] : where.items()) {
    const auto axis = std::find(field.dimensions.begin(), field.dimensions.end(), name);
    if (axis != field.dimensions.end()) {
      keep_on_axis(result, field, std::size_t(axis - field.dimensions.begin()), wanted);
      continue;
    }
    const std::vector<double> values = values_of(result, name, field.values.size());
    for (std::size_t i = 0; i < field.kept.size(); ++i)
      if (!(values[i] >= wanted[0] && values[i] <= wanted[1])) field.kept[i] = false;
  }
}

// Value and error where the abscissa first passes the target along a curve's nodes; NaN if it does not.
CurvePoint interpolate(const Curve& nodes, double target) {
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    const CurvePoint &a = nodes[i - 1], &b = nodes[i];
    if ((a.x - target) * (b.x - target) > 0) continue;
    const double share = b.x == a.x ? 0 : (target - a.x) / (b.x - a.x);
    const double step = std::abs(b.value - a.value);
    return {target, a.value + share * (b.value - a.value),
            std::max(a.error, b.error) + std::min(share, 1 - share) * step};
  }
  return {target, NAN, NAN};
}

// The field without its last dimension, "node", taken where the named variable has the value.
Field reduce(const ResultReader& result, const Field& field, const std::string& name, double target) {
  if (field.shape.empty())
    throw InputError(fmt::format("{}: damaged: what is taken at {} has no nodes", result.path(), name));
  const std::vector<double> abscissa = values_of(result, name, field.values.size());
  const std::vector<double> branch = values_of(result, "branch", field.values.size());
  const bool loading_path = name == "R_n";
  const std::size_t nodes = field.shape.back();
  Field out;
  out.dimensions.assign(field.dimensions.begin(), field.dimensions.end() - 1);
  out.shape.assign(field.shape.begin(), field.shape.end() - 1);
  for (std::size_t start = 0; start < field.values.size(); start += nodes) {
    Curve curve;
    bool kept = false;
    for (std::size_t i = start; i < start + nodes; ++i) {
      kept = kept || field.kept[i];
      const bool on_path = branch[i] == double(Branch::loading) || branch[i] == double(Branch::both);
      if (!std::isfinite(field.values[i]) || (loading_path && !on_path)) continue;
      curve.push_back({abscissa[i], field.values[i], field.errors[i]});
    }
    const CurvePoint at = interpolate(curve, target);
    out.values.push_back(at.value);
    out.errors.push_back(at.error);
    out.kept.push_back(kept);
  }
  return out;
}

Field field_of(const ResultReader& result, const Json& check, const std::string& variable, const Json& more) {
  Field field = read(result, variable);
  if (check.contains("divide_by") && variable == check["variable"])
    for (const auto& [name, power] : check["divide_by"].items()) divide(result, field, name, power);
  select(result, field, check.value("where", Json::object()));
  select(result, field, more.is_null() ? Json::object() : more);
  if (check.contains("at"))
    for (const auto& [name, value] : check["at"].items()) field = reduce(result, field, name, value);
  return field;
}

}  // namespace

Curves curves_of(const ResultReader& result, const Json& check, const Json& more) {
  const std::string variable = check["variable"], along = check["along"];
  const Field y = field_of(result, check, variable, more);
  const std::size_t d = dimension_of(result, y, variable, along), stride = stride_of(y, d);
  const std::vector<double> axis = values_of(result, along, y.shape[d]);
  std::optional<Field> x;
  if (check.contains("x")) x = field_of(result, check, check["x"], more);
  if (x && x->shape != y.shape)
    throw InputError(fmt::format("{}: damaged: {} and {} have other shapes", result.path(), variable,
                                 check["x"].get<std::string>()));
  Curves out;
  out.independent = check.value("errors", "") == "independent";
  for (std::size_t start = 0; start < y.values.size(); ++start) {
    if (start / stride % y.shape[d] != 0) continue;
    Curve curve;
    for (std::size_t k = 0; k < y.shape[d]; ++k) {
      const std::size_t i = start + k * stride;
      if (!y.kept[i]) continue;
      const CurvePoint point{x ? x->values[i] : axis[k], y.values[i], y.errors[i], x ? x->errors[i] : 0};
      if (std::isfinite(point.x) && std::isfinite(point.value) && std::isfinite(point.error))
        curve.push_back(point);
      else if (along != "node") ++out.missing;
    }
    if (!curve.empty()) out.curves.push_back(curve);
  }
  return out;
}

Curves curves_along(const ResultReader& result, Json check, const std::string& along) {
  check["along"] = along;
  return curves_of(result, check);
}

Curve points_of(const ResultReader& result, const Json& check, const Json& more) {
  const Field field = field_of(result, check, check["variable"], more);
  Curve out;
  for (std::size_t i = 0; i < field.values.size(); ++i)
    if (field.kept[i]) out.push_back({double(i), field.values[i], field.errors[i]});
  return out;
}

}  // namespace bristle
