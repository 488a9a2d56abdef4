#include "compare/comparison.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace bristle::compare {
namespace {

constexpr std::size_t kMaxListed = 5;

std::string table(const Comparison& comparison) {
  std::size_t width = 8;
  for (const Difference& d : comparison.differences) width = std::max(width, d.name.size());
  std::string text = fmt::format("{:<{}} {:>7} {:>12} {:>12} {:>12}  {}\n", "variable", width, "differ",
                                 "difference", "relative", "tolerances", "worst at");
  for (const Difference& d : comparison.differences) {
    const auto shown = [](double size) { return std::isfinite(size) ? fmt::format("{:.3g}", size) : "-"; };
    const char* mark = comparison.exact   ? ""
                       : d.above > 0      ? "  FAILED"
                       : d.above_half > 0 ? "  above half its tolerance"
                                          : "";
    text += fmt::format("{:<{}} {:>7} {:>12.3g} {:>12.3g} {:>12}  {}: {} against {}{}\n", d.name, width,
                        d.values, d.absolute, d.relative, shown(d.tolerances), d.place, d.a, d.b, mark);
  }
  return text;
}

std::string outcome(const Comparison& c) {
  const std::size_t differ = c.total(&Difference::values), above = c.total(&Difference::above);
  if (!c.agree()) {
    const std::string tolerance = c.exact ? "" : fmt::format(", {} of them above their tolerances", above);
    return fmt::format("FAILED: {} values differ{}; {} other failures", differ, tolerance, c.failures.size());
  }
  if (c.values == 0) return "not compared";
  if (differ == 0) return "the same, bit for bit";
  return fmt::format(
      "within the tolerances: {} differ, by at most {:.3g} of the tolerance, {} above half of it", differ,
      c.differences[0].tolerances, c.total(&Difference::above_half));
}

Json entry(const Difference& d) {
  return {{"variable", d.name},
          {"place", d.place},
          {"reference", d.b},
          {"now", d.a},
          {"tolerances", std::isfinite(d.tolerances) ? Json(d.tolerances) : Json(nullptr)}};
}

}  // namespace

std::string comparison_text(const Comparison& c, const std::string& remarks) {
  std::string text;
  for (const std::string& note : c.notes) text += fmt::format("note: {}\n", note);
  for (const std::string& failure : c.failures) text += fmt::format("FAILED: {}\n", failure);
  if (!c.differences.empty()) text += table(c);
  text += remarks;
  const std::string where = c.points == c.points_in_file
                                ? fmt::format("{} points", c.points)
                                : fmt::format("{} of {} points", c.points, c.points_in_file);
  return text + fmt::format("{}: {} values at {}: {}\n", c.label, c.values, where, outcome(c));
}

Json comparison_json(const Comparison& c) {
  Json worst = Json::array();
  for (std::size_t i = 0; i < std::min(kMaxListed, c.differences.size()); ++i)
    worst.push_back(entry(c.differences[i]));
  return {{"reference", c.label},
          {"failed", !c.agree()},
          {"values", c.values},
          {"points", c.points},
          {"points_in_file", c.points_in_file},
          {"differ", c.total(&Difference::values)},
          {"above_half", c.total(&Difference::above_half)},
          {"above", c.total(&Difference::above)},
          {"worst", worst},
          {"failures", c.failures},
          {"notes", c.notes}};
}

}  // namespace bristle::compare
