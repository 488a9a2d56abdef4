#include "claims/checks.hpp"

#include "claims/measure.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

namespace bristle::claims {
namespace {

// Returns a count from -1, none, to 1, all, as a percentage: of those that the check wants above, or below.
double percentage(const Check& check, double count) {
  return 50 * (1 + (check.criterion == Criterion::at_most ? -count : count));
}

// Whether the measured number is the share of points or pairs. A check that compares two such numbers, or
// wants one near a number, is none.
bool is_share(const Check& check) {
  const Predicate& predicate = find_predicate(check.predicate);
  return predicate.share_of && check.criterion != Criterion::near &&
         (predicate.on_pairs || check.compare.empty());
}

std::string meaning(const Check& check) {
  return check.interpretation.empty() ? "" : fmt::format(", if {}", printable(check.interpretation));
}

std::string missing(const CheckResult& c) {
  return c.measured.missing ? fmt::format(" [{} points without a value]", c.measured.missing) : "";
}

constexpr std::size_t kIndent = 9, kGap = 2;
constexpr std::size_t kCell = 27;  // of a verdict and its number, such as "undecided -10.399 +- 0.137"

// Returns the readings in the order of their first checks.
std::vector<std::string> readings_of(const std::vector<CheckResult>& checks) {
  std::vector<std::string> readings;
  for (const CheckResult& c : checks)
    if (std::ranges::find(readings, c.check.reading) == readings.end()) readings.push_back(c.check.reading);
  return readings;
}

std::string measured(const CheckResult& c) { return fmt::format("{:<9} {}", word(c.verdict), found_text(c)); }

}  // namespace

std::string required_text(const Check& check) {
  const Predicate& predicate = find_predicate(check.predicate);
  if (is_share(check))
    return fmt::format("{:.3g} % of {} needed", percentage(check, check.threshold), predicate.share_of);
  std::string what = predicate.what;
  if (!check.compare.empty() && predicate.on_curves)
    what += fmt::format(", {} of both", check.difference ? "difference" : "ratio");
  switch (check.criterion) {
    case Criterion::near:
      return fmt::format("{} within {:.3g} of {:.3g}", what, *check.band, check.threshold);
    case Criterion::at_most: return fmt::format("{} at most {:.3g}", what, check.threshold);
    case Criterion::at_least: break;
  }
  return fmt::format("{} at least {:.3g}", what, check.threshold);
}

std::string found_text(const CheckResult& c) {
  const auto& [value, uncertainty] = std::pair{c.measured.value, c.measured.error};
  if (!std::isfinite(value)) return "not measured";
  if (!is_share(c.check)) return fmt::format("{:.3f} +- {:.3f}", value, uncertainty);
  const double share = percentage(c.check, value);
  return uncertainty < 1e-3 ? fmt::format("{:.3g} %", share)
                            : fmt::format("{:.3g} +- {:.2g} %", share, 50 * uncertainty);
}

std::string name_of_reading(const std::string& reading) {
  if (reading == "polar") return "corrected";
  return reading == "polar_as_printed" ? "as printed" : reading;
}

std::string checks_table(const std::vector<CheckResult>& checks, bool all, std::size_t columns) {
  const std::vector<std::string> readings = readings_of(checks);
  // Side by side below a heading, or else below each other, each with its reading.
  const bool side_by_side = kIndent + readings.size() * (kCell + kGap) <= columns + kGap;
  std::string text;
  if (side_by_side && readings.size() > 1) {
    text += fmt::format("{:<{}}", "claim", kIndent);
    for (const std::string& reading : readings)
      text += fmt::format("{:<{}}", name_of_reading(reading), kCell + kGap);
    text = text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
  }
  for (auto first = checks.begin(); first != checks.end();) {
    const auto next = std::find_if(
        first, checks.end(), [&](const CheckResult& c) { return c.check.number != first->check.number; });
    if (first->check.main || all) {
      const std::string statement =
          fmt::format("{}{} ({}){}", printable(first->check.statement), meaning(first->check),
                      required_text(first->check), missing(*first));
      text += fmt::format("{:<{}}{}\n", first->check.main ? printable(first->check.claim) : " further",
                          kIndent, wrapped(statement, columns, kIndent));
      std::vector<std::string> cells;
      for (auto c = first; c != next; ++c)
        cells.push_back(side_by_side ? fmt::format("{:<{}}", measured(*c), c + 1 == next ? 0 : kCell)
                                     : fmt::format("{} {}", name_of_reading(c->check.reading), measured(*c)));
      const std::string indent(kIndent, ' ');
      const std::string between = side_by_side ? std::string(kGap, ' ') : "\n" + indent;
      text += fmt::format("{}{}\n", indent, fmt::join(cells, between));
    }
    first = next;
  }
  return text;
}

}  // namespace bristle::claims
