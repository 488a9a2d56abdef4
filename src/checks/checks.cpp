#include "checks/checks.hpp"

#include "checks/vocabulary.hpp"
#include "experiment/experiment.hpp"

#include <cmath>

namespace bristle {
namespace {

// Below this the association of a trend may be chance.
constexpr double kSignificant = 0.05;

double margin_of(const CheckResult& r) {
  if (r.is == "near") return r.band - std::abs(r.measured.value - r.threshold);
  return r.is == "at_most" ? r.threshold - r.measured.value : r.measured.value - r.threshold;
}

Verdict decide(const Measurement& m, double margin) {
  if (!std::isfinite(m.value) || !std::isfinite(m.uncertainty)) return Verdict::undecided;
  if (margin < -m.uncertainty) return Verdict::refuted;
  if (m.significance > kSignificant) return Verdict::undecided;
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

std::vector<CheckResult> evaluate_checks(const ResultReader& result) {
  std::vector<CheckResult> out;
  // The file's word for them is not taken: what measures relies on each key.
  const Experiment experiment = stored_experiment(result.experiment(), "full", result.path());
  validate_checks(experiment);
  for (const Json& check : experiment.checks) {
    CheckResult r;
    r.claim = check["claim"];
    r.statement = check["statement"];
    r.measured = measure(result, check);
    r.is = check["is"];
    r.threshold = check.value("threshold", 0.0);
    r.band = check.value("band", NAN);
    r.margin = margin_of(r);
    r.verdict = decide(r.measured, r.margin);
    out.push_back(r);
  }
  return out;
}

}  // namespace bristle
