#include "checks/vocabulary.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace bristle {
namespace {

Measurement ratio(const Measurement& a, const Measurement& b) {
  Measurement out = a;
  out.value = a.value / b.value;
  out.uncertainty =
      std::abs(out.value) * (a.uncertainty / std::abs(a.value) + b.uncertainty / std::abs(b.value));
  out.curves += b.curves;
  out.missing += b.missing;
  out.significance = std::numeric_limits<double>::quiet_NaN();
  return out;
}

Measurement difference(const Measurement& a, const Measurement& b) {
  Measurement out = a;
  out.value = a.value - b.value;
  out.uncertainty = a.uncertainty + b.uncertainty;
  out.curves += b.curves;
  out.missing += b.missing;
  out.significance = std::numeric_limits<double>::quiet_NaN();
  return out;
}

Measurement on_curves(const ResultReader& result, const Json& check, const Json& more) {
  const std::string name = check["predicate"];
  const Curves curves = curves_of(result, check, more);
  if (name == "trend") return trend(curves);
  if (name == "end_ratio") return end_ratio(curves);
  if (name == "range_ratio") return range_ratio(curves, curves_along(result, check, check["against"]));
  if (name == "slope") return slope(curves, check.value("scale", "log") == "log");
  if (name == "plateau") return plateau(curves);
  if (name == "level") return level(curves);
  if (name == "steepest_fall") return steepest_fall(curves);
  if (name == "steepness") return steepness(curves);
  if (name == "fall_width") return fall_width(curves);
  if (name == "fold") return fold(curves);
  throw std::logic_error("no predicate " + name);
}

Measurement on_pairs(const Json& check, const Curve& first, const Curve& second) {
  if (check["predicate"] == "concordance") return concordance(first, second);
  if (check["predicate"] == "ordering") return ordering(first, second);
  return equality(first, second, check["resolution"]);
}

}  // namespace

const std::vector<Predicate>& vocabulary() {
  static const std::vector<Predicate> words = {
      {"trend", {"along"}, false},
      {"end_ratio", {"along"}, false},
      {"range_ratio", {"along", "against"}, false},
      {"slope", {"along"}, false},
      {"plateau", {"along"}, false},
      {"level", {"along"}, false},
      {"steepest_fall", {"along"}, false},
      {"steepness", {"along"}, false},
      {"fall_width", {"along"}, false},
      {"fold", {"along"}, false},
      {"concordance", {}, true},
      {"ordering", {}, true},
      {"equality", {"resolution"}, true},
  };
  return words;
}

Measurement measure(const ResultReader& result, const Json& check) {
  const auto word = std::find_if(vocabulary().begin(), vocabulary().end(),
                                 [&](const Predicate& p) { return p.name == check["predicate"]; });
  if (word->pairs && check.contains("expected")) {
    const Curve first = points_of(result, check);
    return on_pairs(check, first, Curve(first.size(), {0, check["expected"], 0}));
  }
  if (!check.contains("compare")) return on_curves(result, check, {});
  const std::string axis = check["compare"].begin().key();
  const Json &values = check["compare"][axis], at_first{{axis, values[0]}}, at_second{{axis, values[1]}};
  if (word->pairs)
    return on_pairs(check, points_of(result, check, at_first), points_of(result, check, at_second));
  const Measurement first = on_curves(result, check, at_first), second = on_curves(result, check, at_second);
  return check.value("by", "ratio") == "ratio" ? ratio(first, second) : difference(first, second);
}

}  // namespace bristle
