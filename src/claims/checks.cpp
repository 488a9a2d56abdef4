#include "claims/checks.hpp"

#include "claims/measure.hpp"
#include "util/error.hpp"
#include "json/json.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <map>

namespace bristle::claims {
namespace {

// A trend with a larger p-value may be due to chance.
constexpr double kSignificanceLevel = 0.05;

// Returns the distance from the threshold or from the end of the band; positive if the claim holds.
double margin_of(const Check& check, double value) {
  switch (check.criterion) {
    case Criterion::near: return *check.band - std::abs(value - check.threshold);
    case Criterion::at_most: return check.threshold - value;
    case Criterion::at_least: break;
  }
  return value - check.threshold;
}

Verdict decide(const Measurement& m, double margin) {
  if (!std::isfinite(m.value) || !std::isfinite(m.error)) return Verdict::undecided;
  if (margin < -m.error) return Verdict::refuted;
  if (m.significance > kSignificanceLevel) return Verdict::undecided;
  return margin >= m.error ? Verdict::supported : Verdict::undecided;
}

// Returns the worse of two verdicts, in the order refuted, undecided, supported.
Verdict worse(Verdict a, Verdict b) {
  if (a == Verdict::refuted || b == Verdict::refuted) return Verdict::refuted;
  return a == Verdict::supported ? b : a;
}

Json checks_of(const std::string& file) {
  const Json content = read_json_file(file);
  if (!content.contains("checks")) throw InputError(file + ": has no /checks to evaluate");
  return content["checks"];
}

// Returns the verdict on a claim under one reading (CheckResult::claim_verdict).
Verdict verdict_on_claim(const std::vector<CheckResult>& checks, const std::string& claim,
                         const std::string& reading) {
  std::map<std::string, Verdict> interpretations;
  for (const CheckResult& c : checks) {
    if (!c.check.main || c.check.claim != claim || c.check.reading != reading) continue;
    const auto [known, first] = interpretations.emplace(c.check.interpretation, c.verdict);
    if (!first) known->second = worse(known->second, c.verdict);
  }
  if (interpretations.empty()) return Verdict::undecided;
  const auto have = [&](Verdict verdict) {
    return std::ranges::count(interpretations, verdict, [](const auto& one) { return one.second; });
  };
  const Verdict first = interpretations.begin()->second;
  if (have(first) == std::ssize(interpretations)) return first;
  return have(Verdict::supported) > 0 ? Verdict::depends : Verdict::undecided;
}

}  // namespace

std::vector<CheckResult> evaluate_checks(const results::ResultReader& result,
                                         const std::string& checks_file) {
  std::vector<CheckResult> out;
  Json document = result.experiment();
  if (!checks_file.empty()) document["checks"] = checks_of(checks_file);
  if (!document.contains("checks")) return out;
  // The checks of a file are untrusted, and the predicates rely on the validation.
  const Experiment experiment =
      experiment::stored_experiment(document, "full", checks_file.empty() ? result.path() : checks_file);
  const std::vector<Check> checks = read_checks(experiment);
  validate_checks(experiment, checks);
  for (const Check& check : checks) {
    CheckResult r{check, measure(result, check), 0, Verdict::undecided, Verdict::undecided};
    r.margin = margin_of(check, r.measured.value);
    r.verdict = decide(r.measured, r.margin);
    out.push_back(std::move(r));
  }
  for (CheckResult& r : out) r.claim_verdict = verdict_on_claim(out, r.check.claim, r.check.reading);
  return out;
}

std::vector<ClaimVerdict> claim_verdicts(const std::vector<CheckResult>& checks) {
  std::vector<ClaimVerdict> out;
  for (const CheckResult& c : checks) {
    const bool known = std::ranges::any_of(out, [&](const ClaimVerdict& verdict) {
      return verdict.claim == c.check.claim && verdict.reading == c.check.reading;
    });
    if (!known) out.push_back({c.check.claim, c.check.reading, c.claim_verdict});
  }
  return out;
}

}  // namespace bristle::claims
