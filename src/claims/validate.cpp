#include "claims/checks.hpp"

#include "claims/measure.hpp"
#include "json/node.hpp"
#include "results/reader.hpp"
#include "results/variables.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

namespace bristle::claims {
namespace {

class CheckValidator {
 public:
  // Lists the names of axes and variables that the check may use.
  CheckValidator(const Experiment& experiment, const Check& check)
      : experiment_(experiment),
        check_(check),
        node_(*experiment.source, fmt::format("/checks/{}", check.number)) {
    for (const results::ResultVariable& v : results::result_variables(experiment.sweep))
      variables_.push_back(v.name);
    for (const sweep::Axis& axis : experiment.sweep.axes) {
      axes_.push_back(results::axis_variable(axis.name));
      for (const sweep::Axis& column : axis.columns)
        variables_.push_back(results::axis_variable(column.name));
    }
  }

  void validate() const {
    require_keys();
    known("variable", check_.variable, variables_);
    if (!check_.along.empty()) known("along", check_.along, axes_);
    if (!check_.against.empty()) known("against", check_.against, axes_);
    if (!check_.x.empty()) known("x", check_.x, variables_);
    for (const auto& [name, power] : check_.divide_by) known("divide_by/" + name, name, variables_);
    for (const auto& [name, value] : check_.where) selects("where/" + name, name, value);
    for (const auto& [name, values] : check_.compare)
      for (const Selection& value : values) selects("compare/" + name, name, value);
    if (check_.pairs != PointPairs::all && check_.predicate != "trend")
      fail("pairs", "is allowed with trend only");
  }

 private:
  using Range = std::array<double, 2>;

  // Throws InputError at a key of the check. key: key of the check, or two keys with a slash between them.
  [[noreturn]] void fail(const std::string& key, const std::string& what) const {
    const std::size_t slash = key.find('/');
    const json::Node node = node_[key.substr(0, slash)];
    (slash == key.npos ? node : node[key.substr(slash + 1)]).fail(what);
  }

  void known(const std::string& key, const std::string& name, const std::vector<std::string>& names) const {
    if (std::find(names.begin(), names.end(), name) == names.end())
      fail(key, fmt::format("\"{}\" is not {}{}; allowed: {}", name,
                            key == "predicate" ? "a predicate" : "in the result", did_you_mean(name, names),
                            fmt::join(names, ", ")));
  }

  void require_keys() const {
    known("predicate", check_.predicate, predicate_names());
    const Predicate& predicate = find_predicate(check_.predicate);
    for (const Need& need : predicate.needs)
      if (!need.met(check_)) fail(need.key, fmt::format("is missing; {} needs it", predicate.name));
    if (predicate.on_pairs && check_.compare.empty() && !check_.expected)
      fail("compare",
           fmt::format("is missing; {} needs either \"compare\", two values of an axis, or \"expected\"",
                       predicate.name));
    if (check_.criterion == Criterion::near && !check_.band)
      fail("band", "is missing; \"near\" needs the largest allowed distance");
  }

  // Requires that the selection is a word of a choice, a value of an axis, or a range of an axis or a
  // variable.
  void selects(const std::string& key, const std::string& name, const Selection& value) const {
    const bool range = std::holds_alternative<Range>(value);
    const auto axis =
        std::find_if(experiment_.sweep.axes.begin(), experiment_.sweep.axes.end(),
                     [&](const sweep::Axis& a) { return results::axis_variable(a.name) == name; });
    if (axis == experiment_.sweep.axes.end()) {
      std::vector<std::string> names = variables_;
      names.insert(names.end(), axes_.begin(), axes_.end());
      known(key, name, names);
      if (!range) fail(key, "a variable needs a range of two numbers, [from, to]");
      return;
    }
    if (!on_axis(*axis, value))
      fail(key, fmt::format("{} {} this axis; allowed: {}", selection_text(value),
                            range ? "contains no value of" : "is not a value of", axis_text(*axis)));
  }

  static bool on_axis(const sweep::Axis& axis, const Selection& value) {
    const sweep::Sweepable& sweepable = axis.quantity();
    return std::any_of(axis.values.begin(), axis.values.end(), [&](double x) {
      if (const Range* range = std::get_if<Range>(&value))
        return x >= (*range)[0] - 1e-9 * std::abs(x) && x <= (*range)[1] + 1e-9 * std::abs(x);
      if (!sweepable.options.empty()) return value == Selection(sweepable.text(x));
      const double* number = std::get_if<double>(&value);
      return number && std::abs(x - *number) <= 1e-9 * std::abs(x);
    });
  }

  static std::string axis_text(const sweep::Axis& axis) {
    std::vector<std::string> texts;
    for (const double x : axis.values) texts.push_back(axis.quantity().text(x));
    return fmt::format("{}", fmt::join(texts, ", "));
  }

  const Experiment& experiment_;
  const Check& check_;
  json::Node node_;
  std::vector<std::string> variables_, axes_;
};

}  // namespace

void validate_checks(const Experiment& experiment, const std::vector<Check>& checks) {
  for (const Check& check : checks) CheckValidator(experiment, check).validate();
}

void validate_checks(const Experiment& experiment) { validate_checks(experiment, read_checks(experiment)); }

}  // namespace bristle::claims
