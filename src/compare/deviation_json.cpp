#include "compare/deviation_json.hpp"

#include "results/datasets.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace bristle::compare {
namespace {

constexpr std::size_t kMaxListed = 5;

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json entry(const Deviation& d, const results::ResultReader& result) {
  return {{"variable", d.variable},
          {"place", results::place(result, d.variable, d.point)},
          {"reference", results::value_text(result, d.variable, d.reference)},
          {"now", results::value_text(result, d.variable, d.now)},
          {"tolerances", finite(d.tolerances)}};
}

}  // namespace

Json deviation_json(const DeviationReport& report, const results::ResultReader& result,
                    const std::string& reference) {
  Json worst = Json::array();
  for (std::size_t i = 0; i < std::min(kMaxListed, report.deviations.size()); ++i)
    worst.push_back(entry(report.deviations[i], result));
  return {{"reference", reference},
          {"failed", report.failed()},
          {"values", report.values},
          {"points", report.points},
          {"points_in_file", report.points_in_file},
          {"differ", report.deviations.size()},
          {"above_half", report.above(0.5)},
          {"above", report.above(1)},
          {"worst", worst},
          {"failures", report.failures},
          {"notes", report.notes}};
}

}  // namespace bristle::compare
