#include "claims/checks.hpp"

#include "util/text.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace bristle::claims {
namespace {

std::string claimed(const Check& check) {
  switch (check.criterion) {
    case Criterion::near: return fmt::format("{:.3g} +- {:.3g}", check.threshold, *check.band);
    case Criterion::at_most: return fmt::format("at most {:.3g}", check.threshold);
    case Criterion::at_least: break;
  }
  return fmt::format("at least {:.3g}", check.threshold);
}

std::string measured(const CheckResult& c) {
  return fmt::format("{:<10} {:>18}", word(c.verdict),
                     fmt::format("{:.3f} +- {:.3f}", c.measured.value, c.measured.uncertainty));
}

std::string missing(const CheckResult& c) {
  return c.measured.missing ? fmt::format(" [{} points without a value]", c.measured.missing) : "";
}

}  // namespace

std::string checks_table(const std::vector<CheckResult>& checks) {
  std::vector<std::string> readings;
  for (const CheckResult& c : checks)
    if (std::ranges::find(readings, c.check.reading) == readings.end()) readings.push_back(c.check.reading);
  std::string text = fmt::format("{:<9}", "claim");
  for (const std::string& reading : readings)
    text += fmt::format("  {:<29}", reading.empty() ? "verdict, measured" : reading);
  text += fmt::format("  {:<14}  {}\n", "claimed", "statement");
  for (auto first = checks.begin(); first != checks.end();) {
    const auto next = std::find_if(
        first, checks.end(), [&](const CheckResult& c) { return c.check.number != first->check.number; });
    text += fmt::format("{:<9}", first->check.main ? printable(first->check.claim) : " further");
    for (auto c = first; c != next; ++c) text += "  " + measured(*c);
    text += fmt::format("  {:<14}  {}{}\n", claimed(first->check), printable(first->check.statement),
                        missing(*first));
    first = next;
  }
  return text;
}

}  // namespace bristle::claims
