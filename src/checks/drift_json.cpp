#include "checks/comparison.hpp"
#include "checks/drift.hpp"

#include <algorithm>
#include <cmath>

namespace bristle {
namespace {

constexpr std::size_t kWorst = 5;  // drifts that are told in full

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json told(const Drift& d, const ResultReader& result) {
  return {{"variable", d.variable},
          {"place", place(result, d.variable, d.point)},
          {"reference", value_text(result, d.variable, d.reference)},
          {"now", value_text(result, d.variable, d.now)},
          {"tolerances", finite(d.units)}};
}

}  // namespace

Json drift_json(const DriftReport& report, const ResultReader& result, const std::string& reference) {
  Json worst = Json::array();
  for (std::size_t i = 0; i < std::min(kWorst, report.drifts.size()); ++i)
    worst.push_back(told(report.drifts[i], result));
  return {{"reference", reference},
          {"failed", report.failed()},
          {"values", report.values},
          {"points", report.points},
          {"points_in_file", report.points_in_file},
          {"differ", report.drifts.size()},
          {"above_half", report.above(0.5)},
          {"above", report.above(1)},
          {"worst", worst},
          {"failures", report.failures},
          {"notes", report.notes}};
}

Json replay_json(const ResultReader& result) {
  const std::size_t points = sweep_points(result), values = result.variable("status").values.size();
  Json commands = Json::array();
  for (std::size_t p = 0; p < values; p += values / points) commands.push_back(replay_command(result, p));
  return commands;
}

}  // namespace bristle
