#include "claims/check.hpp"

#include "json/node.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>

namespace bristle::claims {
namespace {

using json::Node;

Selection read_selection(const Node& node) {
  const Json& value = node.value();
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number()) return value.get<double>();
  if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number())
    node.fail("a range consists of two numbers, [from, to]");
  return std::array{value[0].get<double>(), value[1].get<double>()};
}

PointPairs read_pairs(const std::string& word) {
  if (word == "within") return PointPairs::within;
  return word == "across" ? PointPairs::across : PointPairs::all;
}

Check read_check(const Node& node) {
  Check check;
  for (const auto& [key, member] : {std::pair{"claim", &Check::claim},
                                    {"statement", &Check::statement},
                                    {"interpretation", &Check::interpretation},
                                    {"predicate", &Check::predicate},
                                    {"variable", &Check::variable},
                                    {"along", &Check::along},
                                    {"x", &Check::x},
                                    {"against", &Check::against}})
    check.*member = node.get<std::string>(key, "");
  for (const auto& [key, member] :
       {std::pair{"expected", &Check::expected}, {"resolution", &Check::resolution}, {"band", &Check::band}})
    if (node.has(key)) check.*member = node[key].as<double>();
  for (const auto& [name, power] : node["divide_by"].members())
    check.divide_by.emplace_back(name, power.as<double>());
  for (const auto& [name, selection] : node["where"].members())
    check.where.emplace_back(name, read_selection(selection));
  for (const auto& [name, values] : node["compare"].members()) {
    if (values.value().size() != 2) values.fail("needs two values of the axis");
    check.compare.push_back({name, {read_selection(values[0]), read_selection(values[1])}});
  }
  check.main = node.get<std::string>("role", "main") == "main";
  check.difference = node.get<std::string>("by", "ratio") == "difference";
  check.logarithmic = node.get<std::string>("scale", "log") == "log";
  check.independent_errors = node.get<std::string>("errors", "") == "independent";
  check.pairs = read_pairs(node.get<std::string>("pairs", "all"));
  check.criterion = from_word<Criterion>(node["is"].as<std::string>());
  check.threshold = node.get("threshold", 0.0);
  return check;
}

// Returns every check once for each word of the axis that the node names.
std::vector<Check> for_each_reading(const std::vector<Check>& checks, const Node& node, const Sweep& sweep) {
  const std::string name = node.as<std::string>();
  const std::size_t number = sweep.axis_number(name);
  const sweep::Axis* axis = number < sweep.axes.size() ? &sweep.axes[number] : nullptr;
  if (!axis || axis->quantity().options.empty())
    node.fail(fmt::format("\"{}\" is not a choice that the sweep varies; allowed: a choice in /sweep", name));
  std::vector<Check> out;
  for (const Check& check : checks)
    for (const double value : axis->values) {
      out.push_back(check);
      out.back().reading = axis->quantity().text(value);
      out.back().where.emplace_back(name, out.back().reading);
    }
  return out;
}

}  // namespace

std::vector<Check> read_checks(const Experiment& experiment) {
  std::vector<Check> checks;
  for (const Node& node : Node(*experiment.source, "/checks").elements()) {
    checks.push_back(read_check(node));
    checks.back().number = checks.size() - 1;
  }
  const Node readings(*experiment.source, "/checks_for_each");
  return readings.exists() ? for_each_reading(checks, readings, experiment.sweep) : checks;
}

std::string selection_text(const Selection& selection) {
  return std::visit([](const auto& value) { return shown(Json(value)); }, selection);
}

}  // namespace bristle::claims
