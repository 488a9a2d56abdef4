#include "claims/curves.hpp"

#include "bristle/model/elementary.hpp"
#include "util/error.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

namespace bristle::claims {
namespace {

using Field = CheckedField;

constexpr double kSameValue = 1e-9;  // relative tolerance when selecting values of an axis

std::size_t stride_of(const Field& field, std::size_t dimension) {
  std::size_t stride = 1;
  for (std::size_t d = dimension + 1; d < field.shape.size(); ++d) stride *= field.shape[d];
  return stride;
}

std::size_t dimension_of(const results::ResultReader& result, const Field& field, const std::string& variable,
                         const std::string& name) {
  const auto found = std::find(field.dimensions.begin(), field.dimensions.end(), name);
  if (found == field.dimensions.end())
    throw InputError(fmt::format("{}: {} has no dimension {}{}; it has: {}", result.path(), variable, name,
                                 did_you_mean(name, field.dimensions), fmt::join(field.dimensions, ", ")));
  return std::size_t(found - field.dimensions.begin());
}

// Returns the values of a variable or an axis. Throws InputError unless there are `count` of them.
std::vector<double> values_of(const results::ResultReader& result, const std::string& name,
                              std::size_t count) {
  std::vector<double> values = result.variable(name).values;
  if (values.size() != count)
    throw InputError(
        fmt::format("{}: damaged: {} has {} values, not {}", result.path(), name, values.size(), count));
  return values;
}

Field read(const results::ResultReader& result, const std::string& name) {
  Field field{result.variable(name), {}, {}};
  field.errors.resize(field.values.size(), 0);
  field.kept.resize(field.values.size(), true);
  if (result.has(name + "_err")) field.errors = values_of(result, name + "_err", field.values.size());
  return field;
}

void divide(const results::ResultReader& result, Field& field, const std::string& name, double power) {
  const Field by = read(result, name);
  if (by.shape != field.shape)
    throw InputError(fmt::format("{}: damaged: {} has a different shape than the variable that it divides",
                                 result.path(), name));
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    const double relative = std::abs(power) * by.errors[i] / std::abs(by.values[i]);
    field.values[i] /= pow(by.values[i], power);
    field.errors[i] = field.errors[i] / pow(by.values[i], power) + std::abs(field.values[i]) * relative;
  }
}

// Returns the value of a word on the axis of a choice: its index in the flag meanings.
double index_of(const results::ResultReader& result, const std::string& name, const std::string& word) {
  const auto& words = result.variable(name).about.words;
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end())
    throw InputError(fmt::format("{}: {} is not a value of {}; allowed: {}", result.path(), word, name,
                                 fmt::join(words, ", ")));
  return double(found - words.begin());
}

// Returns a selection on this axis as a range [from, to].
std::array<double, 2> range_of(const results::ResultReader& result, const std::string& name,
                               const Selection& wanted) {
  if (const auto* range = std::get_if<std::array<double, 2>>(&wanted)) return *range;
  const auto* word = std::get_if<std::string>(&wanted);
  const double value = word ? index_of(result, name, *word) : std::get<double>(wanted);
  return {value, value};
}

// Keeps the points whose index along the dimension d is selected.
void keep_along(Field& field, std::size_t d, const std::vector<bool>& selected) {
  const std::size_t stride = stride_of(field, d);
  for (std::size_t i = 0; i < field.kept.size(); ++i)
    if (!selected[i / stride % field.shape[d]]) field.kept[i] = false;
}

void keep_on_axis(const results::ResultReader& result, Field& field, std::size_t d, const Selection& wanted) {
  const std::string& name = field.dimensions[d];
  const std::vector<double> axis = values_of(result, name, field.shape[d]);
  const auto [low, high] = range_of(result, name, wanted);
  const double slack = kSameValue * std::max(std::abs(low), std::abs(high));
  std::vector<bool> selected;
  for (const double x : axis) selected.push_back(x >= low - slack && x <= high + slack);
  if (std::ranges::count(selected, true) == 0)
    throw InputError(fmt::format("{}: the axis {} has no value {}; it has: {:.6g}", result.path(), name,
                                 selection_text(wanted), fmt::join(axis, ", ")));
  keep_along(field, d, selected);
}

void select(const results::ResultReader& result, Field& field, const std::string& name,
            const Selection& wanted) {
  const auto axis = std::ranges::find(field.dimensions, name);
  if (axis != field.dimensions.end())
    return keep_on_axis(result, field, std::size_t(axis - field.dimensions.begin()), wanted);
  const auto [from, to] = std::get<std::array<double, 2>>(wanted);  // a range, by validate_checks()
  const results::Array& v = result.variable(name);
  std::vector<bool> selected;
  for (const double value : v.values) selected.push_back(value >= from && value <= to);
  // A column of a sample has values along one dimension only.
  if (v.dimensions.size() == 1 && field.dimensions.size() > 1) {
    const std::size_t d = dimension_of(result, field, name, v.dimensions.front());
    values_of(result, name, field.shape[d]);
    return keep_along(field, d, selected);
  }
  values_of(result, name, field.values.size());
  for (std::size_t i = 0; i < field.kept.size(); ++i)
    if (!selected[i]) field.kept[i] = false;
}

// Returns the index of the first point behind the largest rise of ln(z_0) between neighbouring points.
std::size_t behind_jump(const std::vector<double>& gaps) {
  std::size_t at = gaps.size();
  double most = 0;
  for (std::size_t k = 1; k < gaps.size(); ++k)
    if (const double rise = log(gaps[k] / gaps[k - 1]); rise > most) {
      most = rise;
      at = k;
    }
  return at;
}

}  // namespace

CheckedCurves::CheckedCurves(const results::ResultReader& result, const Check& check,
                             std::optional<std::size_t> side)
    : result_(result), check_(check), side_(side) {}

CheckedField CheckedCurves::field_of(const std::string& variable) const {
  CheckedField field = read(result_, variable);
  if (variable == check_.variable)
    for (const auto& [name, power] : check_.divide_by) divide(result_, field, name, power);
  for (const auto& [name, wanted] : check_.where) select(result_, field, name, wanted);
  if (side_)
    for (const auto& [name, values] : check_.compare) select(result_, field, name, values[*side_]);
  return field;
}

Curves CheckedCurves::along() const { return curves(check_.along, false); }

Curves CheckedCurves::along(const std::string& dimension) const { return curves(dimension, false); }

Curves CheckedCurves::from_end_to_end() const { return curves(check_.along, true); }

// Returns the curves along a dimension. whole: leaves out curves without a value at their first or last
// selected point
Curves CheckedCurves::curves(const std::string& dimension, bool whole) const {
  const CheckedField y = field_of(check_.variable);
  const std::size_t d = dimension_of(result_, y, check_.variable, dimension), stride = stride_of(y, d);
  const std::vector<double> axis = values_of(result_, dimension, y.shape[d]);
  std::optional<CheckedField> x, gap;
  if (!check_.x.empty()) x = field_of(check_.x);
  if (check_.pairs != PointPairs::all) gap = read(result_, "z_0");
  if (x && x->shape != y.shape)
    throw InputError(fmt::format("{}: damaged: {} and {} have different shapes", result_.path(),
                                 check_.variable, check_.x));
  Curves out;
  out.independent = check_.independent_errors;
  for (std::size_t start = 0; start < y.values.size(); ++start) {
    if (start / stride % y.shape[d] != 0) continue;
    Curve curve;
    std::vector<double> gaps;
    bool first_missing = false, last_missing = false;
    for (std::size_t k = 0; k < y.shape[d]; ++k) {
      const std::size_t i = start + k * stride;
      if (!y.kept[i]) continue;
      const CurvePoint point{x ? x->values[i] : axis[k], y.values[i], y.errors[i], x ? x->errors[i] : 0};
      last_missing = !(std::isfinite(point.x) && std::isfinite(point.value) && std::isfinite(point.error));
      first_missing = first_missing || (last_missing && curve.empty());
      if (!last_missing) {
        curve.push_back(point);
        if (gap) gaps.push_back(gap->values[i]);
      } else {
        ++out.missing;
      }
    }
    for (std::size_t k = behind_jump(gaps); k < gaps.size(); ++k) curve[k].behind_jump = true;
    if (!curve.empty() && !(whole && (first_missing || last_missing))) out.curves.push_back(curve);
  }
  return out;
}

Curve CheckedCurves::points() const {
  const CheckedField field = field_of(check_.variable);
  Curve out;
  for (std::size_t i = 0; i < field.values.size(); ++i)
    if (field.kept[i]) out.push_back({double(i), field.values[i], field.errors[i]});
  return out;
}

}  // namespace bristle::claims
