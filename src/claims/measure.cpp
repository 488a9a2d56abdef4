#include "claims/measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace bristle::claims {
namespace {

Measurement combined(const Measurement& a, const Measurement& b, double value, double uncertainty) {
  Measurement out = a;
  out.value = value;
  out.uncertainty = uncertainty;
  out.curves += b.curves;
  out.missing += b.missing;
  out.significance = std::numeric_limits<double>::quiet_NaN();
  return out;
}

Measurement ratio(const Measurement& a, const Measurement& b) {
  const double value = a.value / b.value;
  return combined(a, b, value,
                  std::abs(value) * (a.uncertainty / std::abs(a.value) + b.uncertainty / std::abs(b.value)));
}

Measurement difference(const Measurement& a, const Measurement& b) {
  return combined(a, b, a.value - b.value, a.uncertainty + b.uncertainty);
}

template <Measurement (*Function)(const Curves&)>
Predicate of_curves(const char* name) {
  return {name,
          {{"along", [](const experiment::Check& c) { return !c.along.empty(); }}},
          [](const CheckedCurves& curves, const experiment::Check&) { return Function(curves.along()); },
          nullptr};
}

std::vector<Predicate> make_predicates() {
  std::vector<Predicate> table = {
      of_curves<trend>("trend"),
      of_curves<end_ratio>("end_ratio"),
      of_curves<plateau>("plateau"),
      of_curves<level>("level"),
      of_curves<steepness>("steepness"),
      of_curves<steepest_fall>("steepest_fall"),
      of_curves<fall_width>("fall_width"),
      of_curves<fold>("fold"),
      of_curves<rise>("rise"),
      of_curves<top_ratio>("top_ratio"),
  };
  const Predicate::Need along = table.front().needs.front();
  table.push_back({"range_ratio",
                   {along, {"against", [](const experiment::Check& c) { return !c.against.empty(); }}},
                   [](const CheckedCurves& curves, const experiment::Check& check) {
                     return range_ratio(curves.along(), curves.along(check.against));
                   },
                   nullptr});
  table.push_back({"slope",
                   {along},
                   [](const CheckedCurves& curves, const experiment::Check& check) {
                     return slope(curves.along(), check.logarithmic);
                   },
                   nullptr});
  table.push_back({"concordance", {}, nullptr, [](const Curve& a, const Curve& b, const experiment::Check&) {
                     return concordance(a, b);
                   }});
  table.push_back({"ordering", {}, nullptr, [](const Curve& a, const Curve& b, const experiment::Check&) {
                     return ordering(a, b);
                   }});
  table.push_back({"equality",
                   {{"resolution", [](const experiment::Check& c) { return c.resolution.has_value(); }}},
                   nullptr,
                   [](const Curve& a, const Curve& b, const experiment::Check& check) {
                     return equality(a, b, *check.resolution);
                   }});
  return table;
}

}  // namespace

const std::vector<Predicate>& predicates() {
  static const std::vector<Predicate> table = make_predicates();
  return table;
}

const Predicate& find_predicate(const std::string& name) {
  const auto found = std::find_if(predicates().begin(), predicates().end(),
                                  [&](const Predicate& p) { return p.name == name; });
  if (found == predicates().end()) throw std::logic_error("no predicate " + name);
  return *found;
}

Measurement measure(const results::ResultReader& result, const experiment::Check& check) {
  const Predicate& predicate = find_predicate(check.predicate);
  const CheckedCurves all(result, check);
  if (predicate.on_pairs && check.expected) {
    const Curve points = all.points();
    return predicate.on_pairs(points, Curve(points.size(), {0, *check.expected, 0}), check);
  }
  if (!check.compare) return predicate.on_curves(all, check);
  const CheckedCurves first(result, check, check.compare->first),
      second(result, check, check.compare->second);
  if (predicate.on_pairs) return predicate.on_pairs(first.points(), second.points(), check);
  const Measurement a = predicate.on_curves(first, check), b = predicate.on_curves(second, check);
  return check.difference ? difference(a, b) : ratio(a, b);
}

}  // namespace bristle::claims
