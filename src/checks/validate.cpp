#include "checks/checks.hpp"
#include "checks/vocabulary.hpp"
#include "util/error.hpp"
#include "util/text.hpp"
#include "results/variables.hpp"
#include "results/writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

namespace bristle {
namespace {

class CheckValidator {
 public:
  CheckValidator(const Experiment& experiment, std::size_t index)
      : experiment_(experiment), index_(index), check_(experiment.checks[index]) {
    for (const ResultVariable& v : result_variables(experiment)) variables_.push_back(v.name);
    for (const Axis& axis : experiment.axes) axes_.push_back(axis_variable(axis.name));
    if (experiment.base.loading.trace) axes_.emplace_back("node");
  }

  void validate() const {
    for (const Predicate& word : vocabulary())
      if (word.name == check_["predicate"]) has_what_it_needs(word);
    known("variable", check_["variable"], variables_);
    for (const char* key : {"along", "against"})
      if (check_.contains(key)) known(key, check_[key], axes_);
    if (check_.contains("x")) known("x", check_["x"], variables_);
    for (const char* key : {"divide_by", "at"})
      for_each(key, [&](const std::string& name, const Json&) {
        known(fmt::format("{}/{}", key, name), name, variables_);
      });
    if (check_.contains("at") && !experiment_.base.loading.trace)
      fail("at", "is for traced curves only (/load/trace)");
    for_each("where", [&](const std::string& name, const Json& value) { selects("where", name, value); });
    for_each("compare", [&](const std::string& name, const Json& value) {
      if (value.size() != 2) fail("compare/" + name, "give two values of the axis");
      for (const Json& one : value) selects("compare", name, one);
    });
  }

 private:
  template <class Visit>
  void for_each(const char* key, Visit visit) const {
    if (!check_.contains(key)) return;
    for (const auto& [name, value] : check_[key].items()) visit(name, value);
  }

  [[noreturn]] void fail(const std::string& key, const std::string& what) const {
    throw InputError(fmt::format("{}: /checks/{}/{}: {}", experiment_.path, index_, key, what));
  }

  void known(const std::string& key, const std::string& name, const std::vector<std::string>& names) const {
    if (std::find(names.begin(), names.end(), name) == names.end())
      fail(key, fmt::format("\"{}\" is not in the result{}; allowed: {}", name, did_you_mean(name, names),
                            fmt::join(names, ", ")));
  }

  void has_what_it_needs(const Predicate& word) const {
    for (const std::string& key : word.needs)
      if (!check_.contains(key)) fail(key, fmt::format("is missing; {} needs it", word.name));
    if (word.pairs && !check_.contains("compare") && !check_.contains("expected"))
      fail("compare",
           fmt::format("is missing; {} compares two values of an axis, or with \"expected\"", word.name));
    if (check_["is"] == "near" && !check_.contains("band"))
      fail("band", "is missing; \"near\" needs the distance allowed");
  }

  // A word of a choice, a value of an axis, or a range of an axis or a variable.
  void selects(const char* key, const std::string& name, const Json& value) const {
    const std::string at = fmt::format("{}/{}", key, name);
    const bool range = value.is_array();
    if (range && (value.size() != 2 || !value[0].is_number() || !value[1].is_number()))
      fail(at, "a range is two numbers");
    const auto axis = std::find_if(experiment_.axes.begin(), experiment_.axes.end(),
                                   [&](const Axis& a) { return axis_variable(a.name) == name; });
    if (axis == experiment_.axes.end()) {
      std::vector<std::string> names = variables_;
      names.insert(names.end(), axes_.begin(), axes_.end());
      known(at, name, names);
      if (!range) fail(at, "give a range, two numbers, of a variable");
      return;
    }
    if (!range && !on_axis(*axis, value))
      fail(at, fmt::format("{} is not a value of that axis; it has: {}", shown(value), axis_text(*axis)));
  }

  static bool on_axis(const Axis& axis, const Json& value) {
    const auto& options = find_sweepable(axis.name)->options;
    const auto same = [&](double x) {
      if (!options.empty()) return value.is_string() && options[std::size_t(x)] == value.get<std::string>();
      return value.is_number() && std::abs(x - value.get<double>()) <= 1e-9 * std::abs(x);
    };
    return std::any_of(axis.values.begin(), axis.values.end(), same);
  }

  static std::string axis_text(const Axis& axis) {
    const auto& options = find_sweepable(axis.name)->options;
    std::vector<std::string> words;
    for (const double x : axis.values)
      words.push_back(options.empty() ? fmt::format("{:.6g}", x) : options[std::size_t(x)]);
    return fmt::format("{}", fmt::join(words, ", "));
  }

  const Experiment& experiment_;
  std::size_t index_;
  const Json& check_;
  std::vector<std::string> variables_, axes_;
};

}  // namespace

void validate_checks(const Experiment& experiment) {
  for (std::size_t i = 0; i < experiment.checks.size(); ++i) CheckValidator(experiment, i).validate();
}

}  // namespace bristle
