#include "experiment/friction_law.hpp"

#include "experiment/overrides.hpp"
#include "bristle/model/friction/formula.hpp"
#include "bristle/model/friction/laws.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace bristle::experiment {
namespace {

constexpr double kFormulaEnd = 10;  // default of /friction_law/to

void check_law(const json::Document& d, const std::string& speeds, const FrictionValues& law) {
  const std::string& at = speeds;
  const auto& [V_R, mu, linear] = law;
  if (V_R.size() != mu.size())
    d.fail("/friction_law/mu", fmt::format("has {} values, and {} has {}; a law needs one mu for each speed",
                                           mu.size(), at.substr(at.rfind('/') + 1), V_R.size()));
  if (V_R[0] != 0 || mu[0] != 0)
    d.fail(V_R[0] != 0 ? at : "/friction_law/mu",
           fmt::format("begins with V_R = {:g}, mu = {:g}; a bristle at rest on the slab has no friction, so "
                       "a law begins with "
                       "V_R = 0, mu = 0, and rises to its static value within a small speed",
                       V_R[0], mu[0]));
  for (std::size_t i = 1; i < V_R.size(); ++i) {
    if (!(V_R[i] > V_R[i - 1]))
      d.fail(fmt::format("{}/{}", at, i),
             fmt::format("the speeds must ascend, but {:g} follows {:g}", V_R[i], V_R[i - 1]));
    if (!(mu[i] > 0))
      d.fail(fmt::format("/friction_law/mu/{}", i),
             fmt::format("{:g} is not allowed; allowed: greater than 0 at a speed", mu[i]));
  }
  if (!linear && V_R.size() < 4)
    d.fail("/friction_law/between",
           fmt::format("pchip needs at least 4 values, and there are {}; use \"linear\"", V_R.size()));
}

std::shared_ptr<const ModulationTable> read_table(const json::Document& d, const Json& law) {
  if (law.contains("to"))
    d.fail("/friction_law/to", "belongs to a formula; the last value of a table holds beyond it");
  const std::string speeds = law.contains("V_R") ? "V_R" : "V_R_m_per_s", at = "/friction_law/" + speeds;
  if (speeds != "V_R" && !d.json().contains("si")) d.fail(at, "needs the block /si; use V_R, in units of V0");
  const FrictionValues values{law[speeds], law["mu"], law.value("between", "pchip") == "linear"};
  check_law(d, at, values);
  try {
    return modulation_table(values);
  } catch (const std::invalid_argument& e) {
    d.fail(at, e.what());
  }
}

std::shared_ptr<const ModulationTable> read_formula(const json::Document& d, const Json& law) {
  if (law.contains("between"))
    d.fail("/friction_law/between", "belongs to a table of V_R and mu, not to a formula");
  try {
    return modulation_table(sampled(parse_formula(law["formula"], "V_R"), law.value("to", kFormulaEnd)));
  } catch (const std::invalid_argument& e) {
    d.fail("/friction_law/formula", e.what());
  }
}

// Whether some point has the law: by an axis, a column of the sample, or the model.
bool uses_custom(const Json& json, const std::vector<sweep::Axis>& axes) {
  for (const sweep::Axis& axis : axes)
    for (const auto& varied : {std::vector{axis}, axis.columns})
      if (const auto found = std::ranges::find(varied, "friction", &sweep::Axis::name); found != varied.end())
        return std::ranges::count(found->values, double(FrictionLaw::custom)) > 0;
  return json["model"]["friction"] == Custom::name;
}

}  // namespace

std::shared_ptr<const ModulationTable> read_friction_law(const json::Document& d,
                                                         const std::vector<sweep::Axis>& axes) {
  const Json& json = d.json();
  const bool used = uses_custom(json, axes);
  if (!json.contains("friction_law")) {
    if (used)
      d.fail(place_of(d, "friction").to_string(),
             "\"custom\" needs the block /friction_law with V_R and mu, or with a formula "
             "(docs/experiments.md)");
    return nullptr;
  }
  const Json& law = json["friction_law"];
  const int speeds = int(law.contains("V_R")) + int(law.contains("V_R_m_per_s"));
  const bool table = speeds == 1 && law.contains("mu"), formula = law.contains("formula");
  if (table == formula || speeds + int(law.contains("mu")) != 2 * int(table)) {
    std::vector<std::string> given;
    for (const char* key : {"V_R", "V_R_m_per_s", "mu", "formula"})
      if (law.contains(key)) given.emplace_back(key);
    d.fail("/friction_law",
           fmt::format("needs either mu and one of V_R and V_R_m_per_s, or a formula, but has {} (a null "
                       "removes a key that is inherited)",
                       given.empty() ? "none of them" : fmt::format("{}", fmt::join(given, ", "))));
  }
  auto out = table ? read_table(d, law) : read_formula(d, law);
  const bool used_by_second = json.value(JsonPointer("/design/second_model/friction"), "") == Custom::name;
  if (!used && !used_by_second)
    d.fail("/friction_law",
           "is the law of no point; choose it by /model/friction: \"custom\", or remove it with null");
  return out;
}

}  // namespace bristle::experiment
