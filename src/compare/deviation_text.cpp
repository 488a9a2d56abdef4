#include "compare/deviation_text.hpp"

#include "compare/replay.hpp"
#include "results/datasets.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

namespace bristle::compare {
namespace {

constexpr std::size_t kMinShown = 5, kMaxShown = 25;
constexpr double kWarning = 0.5;  // in units of the tolerance

std::string row(const results::ResultReader& result, const Deviation& d) {
  const std::string size = std::isfinite(d.tolerances) ? fmt::format("{:.3g}", d.tolerances) : "-";
  const char* verdict = d.tolerances > 1          ? "  FAILED"
                        : d.tolerances > kWarning ? "  above half its tolerance"
                                                  : "";
  return fmt::format("{:<18} {:>10} {:>24} {:>24}  {}{}\n", d.variable, size,
                     results::value_text(result, d.variable, d.reference),
                     results::value_text(result, d.variable, d.now),
                     results::place(result, d.variable, d.point), verdict);
}

std::string replays(const DeviationReport& report, const results::ResultReader& result, std::size_t shown) {
  std::string text;
  std::vector<std::size_t> listed;
  for (std::size_t i = 0; i < shown; ++i) {
    const Deviation& d = report.deviations[i];
    if (std::find(listed.begin(), listed.end(), d.point) != listed.end()) continue;
    listed.push_back(d.point);
    text += fmt::format("To compute {} again:\n  {}\n", results::place(result, d.variable, d.point),
                        replay_command(result, d.point));
  }
  return text;
}

}  // namespace

std::string deviation_text(const DeviationReport& report, const results::ResultReader& result,
                           const std::string& reference) {
  const std::size_t warnings = report.above(kWarning), failed = report.above(1);
  const std::size_t wanted = std::min(std::max(kMinShown, warnings), kMaxShown);
  const std::size_t shown = std::min(wanted, report.deviations.size());
  std::string text;
  for (const std::string& note : report.notes) text += fmt::format("note: {}\n", note);
  for (const std::string& failure : report.failures) text += fmt::format("FAILED: {}\n", failure);
  if (shown > 0)
    text += fmt::format("{:<18} {:>10} {:>24} {:>24}  {}\n", "quantity", "tolerances", "reference", "new",
                        "point");
  for (std::size_t i = 0; i < shown; ++i) text += row(result, report.deviations[i]);
  if (warnings > shown)
    text += fmt::format("... and {} more above half their tolerances\n", warnings - shown);
  text += replays(report, result, shown);
  const std::string where = report.points == report.points_in_file
                                ? fmt::format("{} points", report.points)
                                : fmt::format("{} of {} points", report.points, report.points_in_file);
  const std::string summary = fmt::format("{}: {} values at {}: ", reference, report.values, where);
  if (report.failed())
    return text + fmt::format("{}FAILED: {} above their tolerances, {} other failures\n", summary, failed,
                              report.failures.size());
  if (report.deviations.empty()) return text + summary + "the same, bit for bit\n";
  return text + fmt::format("{}{} differ, by at most {:.3g} of the tolerance, {} above half of it\n", summary,
                            report.deviations.size(), report.deviations[0].tolerances, warnings);
}

}  // namespace bristle::compare
