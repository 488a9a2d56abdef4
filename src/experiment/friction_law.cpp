#include "experiment/friction_law.hpp"

#include "experiment/overrides.hpp"
#include "bristle/model/friction/laws.hpp"
#include "json/node.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace bristle::experiment {
namespace {

using json::Node;

constexpr double kGreatest = 1e6;  // speed or mu in a table, as in the lists of the schema
constexpr std::size_t kMostRows = 10000;

// A law as values, and where they are: in two lists, or in the rows of a table.
struct Curve {
  Node law;
  std::string speeds;  // V_R or V_R_m_per_s
  FrictionValues values;

  bool in_table() const { return law.has("table"); }
  // Returns the place of all speeds, or of all values of mu.
  Node list(const std::string& name) const { return in_table() ? law["table"]["columns"] : law[name]; }
  // Returns the place of one of them.
  Node place(const std::string& name, std::size_t i) const {
    return in_table() ? law["table"]["rows"][i] : law[name][i];
  }
};

// Returns the values of a column of the table with these names of columns.
std::vector<double> column(const Node& table, const std::vector<std::string>& names,
                           const std::string& name) {
  const auto index = std::size_t(std::ranges::find(names, name) - names.begin());
  std::vector<double> values;
  for (const Node& row : table["rows"].elements()) {
    if (row.value().size() != names.size())
      row.fail(fmt::format("has {} values, and the table has {} columns", row.value().size(), names.size()));
    const Json& cell = row.value()[index];
    if (!cell.is_number() || !(cell >= 0 && cell <= kGreatest))
      row.fail(fmt::format("{} = {} is not allowed; allowed: a number from 0 to {:g}", name, shown(cell),
                           kGreatest));
    values.push_back(cell);
  }
  return values;
}

// Reads the table {"columns": [...], "rows": [...]} of a law.
Curve read_columns(const Node& law) {
  const Node table = law["table"];
  const auto names = table["columns"].as<std::vector<std::string>>();
  const std::string speeds = std::ranges::count(names, "V_R") ? "V_R" : "V_R_m_per_s";
  if (names.size() != 2 || !std::ranges::count(names, speeds) || !std::ranges::count(names, "mu"))
    table["columns"].fail(
        fmt::format("the columns are {}; a law has two, V_R_m_per_s or V_R (the speed in "
                    "units of V0), and mu",
                    fmt::join(names, ", ")));
  if (const std::size_t rows = table["rows"].value().size(); rows > kMostRows)
    table["columns"].fail(fmt::format("{} rows; a law has at most {}", rows, kMostRows));
  return {law, speeds, {column(table, names, speeds), column(table, names, "mu")}};
}

// Reads the lists of speeds and mu of a law.
Curve read_lists(const Node& law) {
  const std::string speeds = law.has("V_R") ? "V_R" : "V_R_m_per_s";
  return {law, speeds, {law.value()[speeds], law.value()["mu"]}};
}

void check(const Curve& curve) {
  const auto& [V_R, mu, linear] = curve.values;
  if (V_R.size() != mu.size())
    curve.list("mu").fail(fmt::format("has {} values, and {} has {}; a law needs one mu for each speed",
                                      mu.size(), curve.speeds, V_R.size()));
  if (V_R[0] != 0 || mu[0] != 0) {
    const std::string name = V_R[0] != 0 ? curve.speeds : "mu";
    (curve.in_table() ? curve.place(name, 0) : curve.list(name))
        .fail(fmt::format("begins with {} = {:g}, mu = {:g}; a bristle at rest on the slab has no friction, "
                          "so a law begins with {} = 0, mu = 0, and rises to its static value within a small "
                          "speed",
                          curve.speeds, V_R[0], mu[0], curve.speeds));
  }
  for (std::size_t i = 1; i < V_R.size(); ++i) {
    if (!(V_R[i] > V_R[i - 1]))
      curve.place(curve.speeds, i)
          .fail(fmt::format("the speeds must ascend, but {:g} follows {:g}", V_R[i], V_R[i - 1]));
    if (!(mu[i] > 0))
      curve.place("mu", i).fail(
          fmt::format("{:g} is not allowed; allowed: greater than 0 at a speed", mu[i]));
  }
  if (!linear && V_R.size() < 4)
    curve.law["between"].fail(
        fmt::format("pchip needs at least 4 values, and there are {}; use \"linear\"", V_R.size()));
}

OwnLaw read_curve(const Node& law) {
  Curve curve = law.has("table") ? read_columns(law) : read_lists(law);
  curve.values.linear = law.get<std::string>("between", "pchip") == "linear";
  const bool in_si = curve.speeds == "V_R_m_per_s";
  if (in_si && !law.document().json().contains("si"))
    curve.list(curve.speeds).fail("needs the block /si; use V_R, in units of V0");
  check(curve);
  try {
    return {modulation_table(curve.values), in_si};
  } catch (const std::invalid_argument& e) {
    curve.list(curve.speeds).fail(e.what());
  }
}

// Returns true if some point has the law: by an axis, a column of the sample, or the model.
bool uses_custom(const Json& json, const std::vector<sweep::Axis>& axes) {
  for (const sweep::Axis& axis : axes)
    for (const auto& varied : {std::vector{axis}, axis.columns})
      if (const auto found = std::ranges::find(varied, "friction", &sweep::Axis::name); found != varied.end())
        return std::ranges::count(found->values, double(FrictionLaw::custom)) > 0;
  return json["model"]["friction"] == Custom::name;
}

}  // namespace

OwnLaw read_friction_law(const json::Document& d, const std::vector<sweep::Axis>& axes) {
  const Json& json = d.json();
  const bool used = uses_custom(json, axes);
  if (!json.contains("friction_law")) {
    if (used)
      d.fail(place_of(d, "friction").to_string(),
             "\"custom\" needs the block /friction_law with V_R and mu, or a table "
             "(docs/experiments.md)");
    return {};
  }
  const Node law(d, "/friction_law");
  const bool lists = law.has("mu") && law.has("V_R") != law.has("V_R_m_per_s");
  std::vector<std::string> given;
  for (const char* key : {"V_R", "V_R_m_per_s", "mu", "table"})
    if (law.has(key)) given.emplace_back(key);
  if (given.size() != (lists ? 2 : 1) || (!lists && given[0] != "table"))
    law.fail(
        fmt::format("needs mu and one of V_R and V_R_m_per_s, or a table, but has {} (a "
                    "null removes a key that is inherited)",
                    given.empty() ? "none of them" : fmt::format("{}", fmt::join(given, ", "))));
  const OwnLaw out = read_curve(law);
  if (!used)
    law.fail("is the law of no point; choose it by /model/friction: \"custom\", or remove it with null");
  return out;
}

}  // namespace bristle::experiment
