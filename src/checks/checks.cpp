#include "checks/checks.hpp"

#include "checks/measure.hpp"
#include "checks/validate.hpp"
#include "experiment/experiment.hpp"

#include <nlohmann/json.hpp>

#include <fmt/format.h>
#include <cmath>

namespace bristle::checks {
namespace {

// A trend with a larger p-value may be due to chance.
constexpr double kSignificanceLevel = 0.05;

// Distance from the threshold or from the end of the band; positive if the claim holds.
double margin_of(const experiment::Check& check, double value) {
  switch (check.criterion) {
    case experiment::Criterion::near: return *check.band - std::abs(value - check.threshold);
    case experiment::Criterion::at_most: return check.threshold - value;
    case experiment::Criterion::at_least: break;
  }
  return value - check.threshold;
}

Verdict decide(const Measurement& m, double margin) {
  if (!std::isfinite(m.value) || !std::isfinite(m.uncertainty)) return Verdict::undecided;
  if (margin < -m.uncertainty) return Verdict::refuted;
  if (m.significance > kSignificanceLevel) return Verdict::undecided;
  return margin >= m.uncertainty ? Verdict::supported : Verdict::undecided;
}

}  // namespace

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::supported: return "supported";
    case Verdict::refuted: return "refuted";
    case Verdict::undecided: return "undecided";
  }
  return "?";
}

const char* to_string(experiment::Criterion criterion) {
  switch (criterion) {
    case experiment::Criterion::at_most: return "at_most";
    case experiment::Criterion::at_least: return "at_least";
    case experiment::Criterion::near: return "near";
  }
  return "?";
}

std::vector<CheckResult> evaluate_checks(const results::ResultReader& result) {
  std::vector<CheckResult> out;
  // The checks of a file are untrusted, and the predicates rely on the validation.
  const Experiment experiment = experiment::stored_experiment(result.experiment(), "full", result.path());
  validate_checks(experiment);
  for (const experiment::Check& check : experiment.checks) {
    CheckResult r{check, measure(result, check), 0, Verdict::undecided};
    r.margin = margin_of(check, r.measured.value);
    r.verdict = decide(r.measured, r.margin);
    out.push_back(std::move(r));
  }
  return out;
}

std::string checks_table(const std::vector<CheckResult>& checks) {
  std::string text = fmt::format("{:<5} {:<10} {:>18} {:>14} {:>9}  {}\n", "claim", "verdict", "measured",
                                 "claimed", "margin", "statement");
  for (const CheckResult& c : checks) {
    const std::string measured = fmt::format("{:.3f} +- {:.3f}", c.measured.value, c.measured.uncertainty);
    const std::string claimed =
        c.check.criterion == experiment::Criterion::near
            ? fmt::format("{:.3g} +- {:.3g}", c.check.threshold, *c.check.band)
            : fmt::format("{} {:.3g}",
                          c.check.criterion == experiment::Criterion::at_most ? "at most" : "at least",
                          c.check.threshold);
    text += fmt::format(
        "{:<5} {:<10} {:>18} {:>14} {:>9.3f}  {}{}\n", c.check.claim, to_string(c.verdict), measured, claimed,
        c.margin, c.check.statement,
        c.measured.missing ? fmt::format(" [{} points without a value]", c.measured.missing) : "");
  }
  return text;
}

}  // namespace bristle::checks
