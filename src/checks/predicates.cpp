#include "checks/predicates.hpp"

#include "experiment/input_error.hpp"
#include "experiment/suggest.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <limits>

namespace bristle {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double relative_error(const Curves::Point& p) { return p.error / std::abs(p.value); }

// Mean over the curves of the range of ln(value).
Measurement mean_log_range(const Curves& in) {
  double sum = 0, uncertainty = 0;
  std::size_t used = 0;
  for (const auto& curve : in.curves) {
    if (curve.size() < 2) continue;
    const auto less = [](const Curves::Point& a, const Curves::Point& b) { return a.value < b.value; };
    const auto [low, high] = std::minmax_element(curve.begin(), curve.end(), less);
    sum += std::log(high->value / low->value);
    uncertainty += relative_error(*low) + relative_error(*high);
    ++used;
  }
  if (used == 0) return {kNone, kNone, 0, in.missing};
  return {sum / double(used), uncertainty / double(used), used, in.missing};
}

}  // namespace

Curves curves_along(const ResultReader& result, const std::string& name, const std::string& along) {
  const Variable v = result.variable(name);
  std::vector<double> error(v.values.size(), 0);
  const auto known = result.variables();
  if (std::find(known.begin(), known.end(), name + "_err") != known.end())
    error = result.variable(name + "_err").values;
  const auto dimension = std::find(v.dimensions.begin(), v.dimensions.end(), along);
  if (dimension == v.dimensions.end())
    throw InputError(fmt::format("{}: {} has no dimension {}{}; it has: {}", result.path(), name, along,
                                 did_you_mean(along, v.dimensions), fmt::join(v.dimensions, ", ")));
  const auto d = std::size_t(dimension - v.dimensions.begin());
  std::size_t stride = 1;
  for (std::size_t i = d + 1; i < v.shape.size(); ++i) stride *= v.shape[i];
  const std::size_t length = v.shape[d];
  Curves out;
  for (std::size_t start = 0; start < v.values.size(); ++start) {
    if (start / stride % length != 0) continue;
    out.curves.emplace_back();
    for (std::size_t i = start; i < start + length * stride; i += stride)
      if (std::isfinite(v.values[i]) && std::isfinite(error[i]))
        out.curves.back().push_back({v.values[i], error[i]});
      else ++out.missing;
  }
  return out;
}

Measurement trend(const Curves& in) {
  long rising = 0, falling = 0, pairs = 0;
  std::size_t used = 0;
  for (const auto& curve : in.curves) {
    if (curve.size() >= 2) ++used;
    for (std::size_t i = 0; i < curve.size(); ++i)
      for (std::size_t j = i + 1; j < curve.size(); ++j) {
        const double change = curve[j].value - curve[i].value;
        const double unsure = curve[i].error + curve[j].error;
        ++pairs;
        if (change > unsure) ++rising;
        if (change < -unsure) ++falling;
      }
  }
  if (pairs == 0) return {kNone, kNone, 0, in.missing};
  const double unresolved = double(pairs - rising - falling);
  return {double(rising - falling) / double(pairs), unresolved / double(pairs), used, in.missing};
}

Measurement end_ratio(const Curves& in) {
  double sum = 0, uncertainty = 0;
  std::size_t used = 0;
  for (const auto& curve : in.curves) {
    if (curve.size() < 2) continue;
    sum += std::log(curve.back().value / curve.front().value);
    uncertainty += relative_error(curve.front()) + relative_error(curve.back());
    ++used;
  }
  if (used == 0) return {kNone, kNone, 0, in.missing};
  const double ratio = std::exp(sum / double(used));
  return {ratio, ratio * uncertainty / double(used), used, in.missing};
}

Measurement range_ratio(const Curves& along, const Curves& against) {
  const Measurement a = mean_log_range(along), b = mean_log_range(against);
  const double ratio = a.value / b.value;
  const double uncertainty = ratio * (a.uncertainty / a.value + b.uncertainty / b.value);
  return {ratio, uncertainty, a.curves + b.curves, a.missing};
}

}  // namespace bristle
