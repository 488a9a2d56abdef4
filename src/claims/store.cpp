#include "claims/store.hpp"

#include "results/writer.hpp"

#include <cmath>

namespace bristle::claims {

using C = const CheckResult&;

results::Dataset dataset_of(const std::vector<CheckResult>& checks) {
  results::Dataset out("checks");
  out.add_dimension(results::row_numbers("check", "number of the check", checks.size()));
  const auto add = [&](const char* name, const char* meaning, auto value) {
    out.add({.name = name, .long_name = meaning, .symbol = "", .equation = "", .units = ""},
            [&](std::size_t i) { return value(checks[i]); });
  };
  add("claim", "identifier of the claim", [](C c) { return c.check.claim; });
  add("statement", "text of the claim", [](C c) { return c.check.statement; });
  add("reading", "value of the choice at which the check is evaluated", [](C c) { return c.check.reading; });
  add("role", "main checks decide the verdict on the claim",
      [](C c) { return std::string(c.check.main ? "main" : "further"); });
  add("is", "required relation of the measured number to the threshold",
      [](C c) { return std::string(word(c.check.criterion)); });
  add("required", "what the check requires, in words", [](C c) { return required_text(c.check); });
  add("found", "what was measured, in words", [](C c) { return found_text(c); });
  add("interpretation", "meaning of the paper's sentence under which the check belongs to the claim",
      [](C c) { return c.check.interpretation; });
  add("verdict", "verdict of the check", [](C c) { return std::string(word(c.verdict)); });
  add("claim_verdict", "verdict on the claim under this reading, by its main checks",
      [](C c) { return std::string(word(c.claim_verdict)); });
  add("declared", "number of the check in the experiment", [](C c) { return double(c.check.number); });
  add("measured", "measured number", [](C c) { return c.measured.value; });
  add("uncertainty", "uncertainty of the measured number", [](C c) { return c.measured.error; });
  add("threshold", "required number", [](C c) { return c.check.threshold; });
  add("band", "greatest distance from the threshold that counts as near",
      [](C c) { return c.check.band.value_or(NAN); });
  add("margin", "distance from the threshold or from the end of the band, positive if the claim holds",
      [](C c) { return c.margin; });
  add("significance", "two-sided p-value of a trend", [](C c) { return c.measured.significance; });
  return out;
}

void write_checks(const std::string& path, const std::vector<CheckResult>& checks) {
  results::replace_group(path, dataset_of(checks));
}

}  // namespace bristle::claims
