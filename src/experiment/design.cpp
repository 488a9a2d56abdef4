#include "experiment/design.hpp"

#include "experiment/sample.hpp"
#include "experiment/schema.hpp"
#include "bristle/model/elementary.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace bristle::experiment {
namespace {

constexpr double kNoNominal = std::numeric_limits<double>::quiet_NaN(), kNoTarget = kNoNominal,
                 kNoLimit = std::numeric_limits<double>::infinity();

// The largest relative deviation: a normal one of a sample of a million is within five standard deviations.
double reach(const Tolerance& t) { return t.width * (t.normal ? 5 : 1); }

class DesignReader {
 public:
  explicit DesignReader(const Document& document) : document_(document), json_(document.json()["design"]) {}

  Design read() const {
    Design d{};
    const Json none = Json::object(), tolerances = json_.value("tolerances", none),
               second_model = json_.value("second_model", none);
    for (const auto& [name, range] : json_["variables"].items()) d.variables.push_back(variable(name, range));
    for (const auto& [name, deviation] : tolerances.items())
      d.tolerances.push_back(tolerance(name, deviation, d.variables));
    d.tolerance_samples = d.tolerances.empty() ? 0 : json_.value("tolerance_samples", std::size_t(16));
    for (std::size_t i = 0; i < json_["objectives"].size(); ++i)
      d.objectives.push_back(objective(kDesign / "objectives" / i, !d.tolerances.empty()));
    if (json_.contains("constraints"))
      for (std::size_t i = 0; i < json_["constraints"].size(); ++i)
        d.constraints.push_back(constraint(kDesign / "constraints" / i));
    d.budget = json_["budget"];
    d.seed = json_.value("seed", std::uint64_t(1));
    for (const auto& [name, word] : second_model.items()) {
      const JsonPointer at = kDesign / "second_model" / name;
      const Sweepable& choice = require_sweepable(document_, at, name);
      if (choice.options.empty()) fail(at, name + " is a number; a second model differs by a choice");
      if (!d.second_choice.empty()) fail(at, "only one choice may differ");
      if (document_.json().contains("sweep") && document_.json()["sweep"].contains(name))
        fail(at, name + " is varied by the sweep, too; remove one of them");
      d.second_choice = name;
      d.second_option = option_index(document_, at, choice, word);
    }
    check_load(d);
    check_reach(d);
    return d;
  }

 private:
  const JsonPointer kDesign{"/design"};

  [[noreturn]] void fail(const JsonPointer& at, const std::string& what) const {
    document_.fail(at.to_string(), what);
  }

  void require_number(const JsonPointer& at, const std::string& name) const {
    if (!require_sweepable(document_, at, name).options.empty())
      fail(at, name + " is a choice, not a number; put its words into the sweep as scenarios");
    if (parameter_schema(name).value("type", "") == "integer")
      fail(at, name +
                   " is an integer, between whose values there is nothing; put its values into the sweep as "
                   "scenarios");
    if (document_.json().contains("sweep") && document_.json()["sweep"].contains(name))
      fail(at, name + " is varied by the sweep, too; remove one of them");
  }

  DesignVariable variable(const std::string& name, const Json& range) const {
    const JsonPointer at = kDesign / "variables" / name;
    require_number(at, name);
    const bool log = range.is_object();
    const Json& ends = log ? range["log"] : range;
    DesignVariable v{name, ends[0], ends[1], log};
    if (!(v.low < v.high))
      fail(at, fmt::format("the lower bound {} is not below the upper bound {}; {}", v.low, v.high,
                           v.low == v.high ? "give a range, or remove the variable" : "swap them"));
    if (log && !(v.low > 0)) fail(at, fmt::format("a logarithmic range cannot begin at {}", v.low));
    require_distinct(document_, at, v.low, v.high, json_["budget"]);
    check_values(document_, name, {v.low, v.high}, [&](std::size_t) { return JsonPointer(at); });
    return v;
  }

  Tolerance tolerance(const std::string& name, const Json& deviation,
                      const std::vector<DesignVariable>& variables) const {
    const JsonPointer at = kDesign / "tolerances" / name;
    require_number(at, name);
    const bool normal = deviation.contains("normal");
    Tolerance t{
        name, normal, deviation.front(),
        std::ranges::count(variables, name, &DesignVariable::name) > 0 ? kNoNominal : nominal(at, name)};
    if (t.nominal == 0)
      fail(at,
           fmt::format(
               "deviates relative to {}, which is 0, so that every deviation is 0, too; remove it, or give "
               "{} another value",
               name, name));
    if (reach(t) >= 1)
      fail(at, fmt::format("{} is too wide: values could reach zero; allowed: less than {}", t.width,
                           normal ? 0.2 : 1.0));
    return t;
  }

  // The values of all points of the design are in the ranges of their quantities.
  void check_reach(const Design& d) const {
    for (const Axis& extremes : extremes_of(d)) {
      const bool varied = std::ranges::count(d.tolerances, extremes.name, &Tolerance::name) > 0;
      check_values(document_, extremes.name, extremes.values, [&](std::size_t) {
        return kDesign / (varied ? "tolerances" : "variables") / extremes.name;
      });
    }
  }

  double nominal(const JsonPointer& at, const std::string& name) const {
    for (const char* block : {"/si", "/model", "/load", "/orientation"})
      if (const JsonPointer place = JsonPointer(block) / name;
          document_.json().contains(place) && document_.json().at(place).is_number())
        return document_.json().at(place);
    fail(at, fmt::format("has no nominal value; give {} in its block, or make it a variable", name));
  }

  Objective objective(const JsonPointer& at, bool tolerances) const {
    const Json& json = document_.json().at(at);
    Objective out{Goal::minimise, "", tolerances ? Statistic::mean : Statistic::nominal, kNoTarget};
    std::size_t goals = 0;
    for (const char* goal : words<Goal>())
      if (json.contains(goal)) {
        ++goals;
        out.goal = from_word<Goal>(goal);
        out.variable = json[goal];
      }
    if (goals != 1)
      fail(at, fmt::format("{} goals are given; one is needed: minimise, maximise or target", goals));
    if (json.contains("of")) out.of = from_word<Statistic>(json["of"]);
    if (!tolerances && out.of != Statistic::nominal)
      fail(at / "of", fmt::format("{} is over tolerances, and there are none", word(out.of)));
    if ((out.goal == Goal::target) != json.contains("value"))
      fail(at / "value",
           out.goal == Goal::target ? "is missing; target needs it" : "is allowed with target only");
    if (json.contains("value")) out.target = json["value"];
    return out;
  }

  Constraint constraint(const JsonPointer& at) const {
    const Json& json = document_.json().at(at);
    const bool margin = json.contains(kJumpMargin);
    if (margin == json.contains("variable") || (margin && json.size() > 1))
      fail(at, "needs either jump_margin alone, or a variable with min, max or both");
    if (margin) return {kJumpMargin, json[kJumpMargin], kNoLimit};
    if (!json.contains("min") && !json.contains("max"))
      fail(at, fmt::format("gives {} no limit; add min, max or both", json["variable"].get<std::string>()));
    Constraint c{json["variable"], json.value("min", -kNoLimit), json.value("max", kNoLimit)};
    if (c.min > c.max) fail(at, fmt::format("min {} is above max {}; swap them", c.min, c.max));
    return c;
  }

  void check_load(const Design& d) const {
    const Json& load = document_.json()["load"];
    if (load.contains("z_0") && d.jump_margin() > 0)
      fail(kDesign / "constraints", "jump_margin needs a load R_n: at a given gap, no gap jumps");
    if (load.contains("trace")) fail(kDesign, "cannot be combined with a trace of R_n(z_0)");
  }

  const Document& document_;
  const Json& json_;
};

}  // namespace

double DesignVariable::at(double share) const {
  if (share <= 0 || share >= 1) return share <= 0 ? low : high;
  return rounded(log ? low * pow(high / low, share) : low + (high - low) * share);
}

std::string Objective::text() const {
  return fmt::format("{} {}{}{}", word(goal), variable,
                     goal == Goal::target ? fmt::format(" {:g}", target) : "",
                     of == Statistic::nominal ? "" : fmt::format(" ({})", word(of)));
}

std::string Constraint::text() const {
  return fmt::format("{}{}{}", std::isfinite(min) ? fmt::format("{:g} <= ", min) : "", variable,
                     std::isfinite(max) ? fmt::format(" <= {:g}", max) : "");
}

double Design::jump_margin() const {
  const auto found = std::ranges::find(constraints, kJumpMargin, &Constraint::variable);
  return found == constraints.end() ? 0 : found->min;
}

std::vector<std::string> Design::quantities() const {
  std::vector<std::string> names;
  for (const DesignVariable& v : variables) names.push_back(v.name);
  for (const Tolerance& t : tolerances)
    if (!std::isnan(t.nominal)) names.push_back(t.name);
  return names;
}

std::optional<Design> read_design(const Document& document) {
  if (!document.json().contains("design")) return {};
  return DesignReader(document).read();
}

std::vector<Axis> extremes_of(const Design& design) {
  std::vector<Axis> axes;
  for (const DesignVariable& v : design.variables) axes.push_back({v.name, {v.low, v.high}});
  for (const Tolerance& t : design.tolerances) {
    const bool is_variable = std::ranges::count(axes, t.name, &Axis::name) > 0;
    // The neighbours that a jump margin needs are within the bounds of a variable.
    const double change = is_variable ? reach(t) : std::max(reach(t), design.jump_margin());
    if (!is_variable) axes.push_back({t.name, {t.nominal, t.nominal}});
    Axis& axis = *std::ranges::find(axes, t.name, &Axis::name);
    const double low = axis.values.front(), high = axis.values.back();
    axis.values = {rounded(low * (1 - change)), rounded(low * (1 + change)), rounded(high * (1 - change)),
                   rounded(high * (1 + change))};
    const auto [least, greatest] = std::ranges::minmax(axis.values);
    axis.values = {least, greatest};
  }
  return axes;
}

std::vector<Axis> bounds_of(const Design& design) {
  std::vector<Axis> columns;
  for (const DesignVariable& v : design.variables) columns.push_back({v.name, {v.low, v.high}});
  for (const Tolerance& t : design.tolerances)
    if (!std::isnan(t.nominal))
      columns.push_back({t.name, {t.nominal * (1 - t.width), t.nominal * (1 + t.width)}});
  return columns;
}

}  // namespace bristle::experiment
