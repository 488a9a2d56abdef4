#include "design/statistics.hpp"

#include "design/search.hpp"

#include <algorithm>
#include <cmath>

namespace bristle::design {
namespace {

constexpr double kNormal95 =
    1.6448536;  // 95 % of a normal distribution lie below this many standard deviations

}  // namespace

Quantity value_of(const results::PointRecord& record, const std::string& variable) {
  const std::string error = variable + "_err";
  return {record.at(variable), record.layout->has(error) ? record.at(error) : 0};
}

namespace {

// Returns a quantile of few values. z: the same quantile of a normal distribution, in standard deviations
// from its mean. The error is the larger of two. One is from a bootstrap, which cannot see beyond the extreme
// values. The other is the standard error of a normal distribution's quantile, plus the distance to this
// quantile if fewer than one value is expected beyond it.
Quantity tail_quantile(const std::vector<double>& values, double share, double z, double mean,
                       double deviation) {
  Quantity out = quantile(values, share);
  const double n = double(values.size());
  double error = deviation * std::sqrt((1 + z * z / 2) / n);
  if (n * std::min(share, 1 - share) < 1) error += std::abs(mean + z * deviation - out.value);
  out.error = std::fmax(out.error, error);
  return out;
}

}  // namespace

double mean_square_error(const std::vector<Quantity>& all) {
  double sum = 0;
  for (const Quantity& one : all) sum += one.error * one.error / double(all.size());
  return sum;
}

Quantity statistic(Statistic of, const std::vector<Quantity>& all) {
  std::vector<double> values;
  double sum = 0, sum_of_squares = 0;
  const double n = double(all.size());
  for (const Quantity& one : all) {
    values.push_back(one.value);
    sum += one.value;
  }
  if (std::isnan(sum)) return {kNone, kNone};
  const double mean = sum / n;
  for (const double value : values) sum_of_squares += (value - mean) * (value - mean);
  const double deviation = std::sqrt(sum_of_squares / std::max(n - 1, 1.0));
  const auto with_errors = [&](Quantity e) {
    return Quantity{e.value, std::sqrt(e.error * e.error + mean_square_error(all))};
  };
  const auto smaller = [](const Quantity& a, const Quantity& b) { return a.value < b.value; };
  switch (of) {
    case Statistic::mean: return with_errors({mean, deviation / std::sqrt(n)});
    case Statistic::q05: return with_errors(tail_quantile(values, 0.05, -kNormal95, mean, deviation));
    case Statistic::q95: return with_errors(tail_quantile(values, 0.95, kNormal95, mean, deviation));
    case Statistic::least: return *std::ranges::min_element(all, smaller);
    case Statistic::greatest: return *std::ranges::max_element(all, smaller);
    case Statistic::nominal: break;
  }
  return all.front();
}

double cost(const Objective& objective, double value) {
  switch (objective.goal) {
    case Goal::minimise: return value;
    case Goal::maximise: return -value;
    case Goal::target: break;
  }
  return std::abs(value - objective.target);
}

std::size_t worst_scenario(const Objective& objective, const std::vector<Quantity>& by_scenario) {
  const auto of = [&](const Quantity& e) {
    return std::isnan(e.value) ? kInfinity : cost(objective, e.value);
  };
  return std::size_t(std::ranges::max_element(by_scenario, {}, of) - by_scenario.begin());
}

}  // namespace bristle::design
