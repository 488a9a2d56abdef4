#include "claims/measure.hpp"

#include "util/error.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

namespace bristle::claims {
namespace {

Measurement combined(const Measurement& a, const Measurement& b, double value, double uncertainty) {
  Measurement out = a;
  out.value = value;
  out.error = uncertainty;
  out.curves += b.curves;
  out.missing += b.missing;
  out.significance = std::numeric_limits<double>::quiet_NaN();
  return out;
}

Measurement ratio(const Measurement& a, const Measurement& b) {
  const double value = a.value / b.value;
  return combined(a, b, value, std::abs(value) * (a.error / std::abs(a.value) + b.error / std::abs(b.value)));
}

Measurement difference(const Measurement& a, const Measurement& b) {
  return combined(a, b, a.value - b.value, a.error + b.error);
}

template <Measurement (*Function)(const Curves&)>
Measurement along(const CheckedCurves& curves, const Check&) {
  return Function(curves.along());
}

template <Measurement (*Function)(const Curves&)>
Measurement end_to_end(const CheckedCurves& curves, const Check&) {
  return Function(curves.from_end_to_end());
}

Measurement range_ratio_of(const CheckedCurves& curves, const Check& check) {
  return range_ratio(curves.along(), curves.along(check.against));
}

Measurement trend_of(const CheckedCurves& curves, const Check& check) {
  return trend(curves.along(), check.pairs);
}

Measurement rise_of(const CheckedCurves& curves, const Check& check) {
  Measurement out = rise(curves.from_end_to_end());
  if (check.resolution && std::abs(out.value) < *check.resolution) out.error = INFINITY;
  return out;
}

Measurement slope_of(const CheckedCurves& curves, const Check& check) {
  return slope(curves.along(), check.logarithmic);
}

template <Measurement (*Function)(const Curve&, const Curve&)>
Measurement of_pairs(const Curve& first, const Curve& second, const Check&) {
  return Function(first, second);
}

Measurement equality_of(const Curve& first, const Curve& second, const Check& check) {
  return equality(first, second, *check.resolution);
}

constexpr Need kAlong{"along", [](const Check& c) { return !c.along.empty(); }};
constexpr Need kX{"x", [](const Check& c) { return !c.x.empty(); }};
constexpr Need kAgainst{"against", [](const Check& c) { return !c.against.empty(); }};
constexpr Need kResolution{"resolution", [](const Check& c) { return c.resolution.has_value(); }};

}  // namespace

const std::vector<Predicate>& predicates() {
  static const std::vector<Predicate> table = {
      {"trend", "share of rising pairs of points", "the pairs of points", {kAlong}, trend_of, nullptr},
      {"end_ratio", "last over first value", nullptr, {kAlong}, end_to_end<end_ratio>, nullptr},
      {"rise", "rise of the logarithm", nullptr, {kAlong}, rise_of, nullptr},
      {"share", "share in the change of the logarithm", nullptr, {kAlong, kX}, end_to_end<share>, nullptr},
      {"third_ratio",
       "mean of the last third over the mean of the first",
       nullptr,
       {kAlong},
       end_to_end<third_ratio>,
       nullptr},
      {"linearity", "distance from a line over its range", nullptr, {kAlong}, along<linearity>, nullptr},
      {"top_ratio", "largest over first value", nullptr, {kAlong}, end_to_end<top_ratio>, nullptr},
      {"range_ratio",
       "ratio of the ranges of the logarithm",
       nullptr,
       {kAlong, kAgainst},
       range_ratio_of,
       nullptr},
      {"slope", "slope", nullptr, {kAlong}, slope_of, nullptr},
      {"plateau", "range over the mean", nullptr, {kAlong}, along<plateau>, nullptr},
      {"level", "mean value", nullptr, {kAlong}, along<level>, nullptr},
      {"steepest_fall", "place of the steepest fall", nullptr, {kAlong}, along<steepest_fall>, nullptr},
      {"steepness", "steepest slope", nullptr, {kAlong}, along<steepness>, nullptr},
      {"fall_width", "width of the fall", nullptr, {kAlong}, along<fall_width>, nullptr},
      {"fold", "largest relative drop", nullptr, {kAlong}, along<fold>, nullptr},
      {"ordering", "share of points", "the points", {}, nullptr, of_pairs<ordering>},
      {"concordance",
       "share of pairs of points at which both rise or both fall",
       "the pairs of points",
       {},
       nullptr,
       of_pairs<concordance>},
      {"equality",
       "root mean square difference over its error",
       nullptr,
       {kResolution},
       nullptr,
       equality_of},
  };
  return table;
}

std::vector<std::string> predicate_names() {
  std::vector<std::string> names;
  for (const Predicate& p : predicates()) names.emplace_back(p.name);
  return names;
}

const Predicate& find_predicate(const std::string& name) {
  return *std::ranges::find(predicates(), name, &Predicate::name);
}

Measurement measure(const results::ResultReader& result, const Check& check) {
  const Predicate& predicate = find_predicate(check.predicate);
  const CheckedCurves all(result, check);
  if (predicate.on_pairs && check.expected) {
    const Curve points = all.points();
    return predicate.on_pairs(points, Curve(points.size(), {0, *check.expected, 0}), check);
  }
  if (check.compare.empty()) return predicate.on_curves(all, check);
  const CheckedCurves first(result, check, 0), second(result, check, 1);
  if (predicate.on_pairs) {
    const Curve a = first.points(), b = second.points();
    if (a.size() != b.size())
      throw InputError(
          fmt::format("{}: the check \"{}\" compares {} points with {}; give ranges with as many points",
                      result.path(), check.statement, a.size(), b.size()));
    return predicate.on_pairs(a, b, check);
  }
  const Measurement a = predicate.on_curves(first, check), b = predicate.on_curves(second, check);
  return check.difference ? difference(a, b) : ratio(a, b);
}

}  // namespace bristle::claims
