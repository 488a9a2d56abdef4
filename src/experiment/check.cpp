#include "experiment/check.hpp"

#include "util/error.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace bristle::experiment {
namespace {

class CheckReader {
 public:
  CheckReader(const Json& json, std::string place) : json_(json), place_(std::move(place)) {}

  Check read() const {
    Check check;
    for (const auto& [key, member] : {std::pair{"claim", &Check::claim},
                                      {"statement", &Check::statement},
                                      {"interpretation", &Check::interpretation},
                                      {"predicate", &Check::predicate},
                                      {"variable", &Check::variable},
                                      {"along", &Check::along},
                                      {"x", &Check::x},
                                      {"against", &Check::against}})
      check.*member = json_.value(key, "");
    for (const auto& [key, member] : {std::pair{"expected", &Check::expected},
                                      {"resolution", &Check::resolution},
                                      {"band", &Check::band}})
      if (json_.contains(key)) check.*member = json_[key].get<double>();
    for_each("divide_by", [&](const std::string& name, const Json& power) {
      check.divide_by.emplace_back(name, power.get<double>());
    });
    for_each("where", [&](const std::string& name, const Json& value) {
      check.where.emplace_back(name, selection("where/" + name, value));
    });
    for_each("at", [&](const std::string& name, const Json& value) {
      check.at.emplace(name, value.get<double>());
    });
    for_each("compare", [&](const std::string& name, const Json& values) {
      if (values.size() != 2) fail("compare/" + name, "needs two values of the axis");
      check.compare.push_back(
          {name, {selection("compare/" + name, values[0]), selection("compare/" + name, values[1])}});
    });
    check.main = json_.value("role", "main") == "main";
    check.difference = json_.value("by", "ratio") == "difference";
    check.logarithmic = json_.value("scale", "log") == "log";
    check.independent_errors = json_.value("errors", "") == "independent";
    const std::string pairs = json_.value("pairs", "all");
    check.pairs = pairs == "within"   ? PointPairs::within
                  : pairs == "across" ? PointPairs::across
                                      : PointPairs::all;
    check.criterion = from_word<Criterion>(json_["is"]);
    check.threshold = json_.value("threshold", 0.0);
    return check;
  }

 private:
  [[noreturn]] void fail(const std::string& key, const std::string& what) const {
    throw InputError(fmt::format("{}/{}: {}", place_, key, what));
  }

  template <class Visit>
  void for_each(const char* key, Visit visit) const {
    if (!json_.contains(key)) return;
    for (const auto& [name, value] : json_[key].items()) visit(name, value);
  }

  Selection selection(const std::string& key, const Json& value) const {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number()) return value.get<double>();
    if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number())
      fail(key, "a range consists of two numbers, [from, to]");
    return std::array{value[0].get<double>(), value[1].get<double>()};
  }

  const Json& json_;
  std::string place_;
};

}  // namespace

std::vector<Check> read_checks(const Json& document, const std::string& source) {
  std::vector<Check> checks;
  if (!document.contains("checks")) return checks;
  for (const Json& json : document["checks"]) {
    const std::size_t number = checks.size();
    checks.push_back(CheckReader(json, fmt::format("{}: /checks/{}", source, number)).read());
    checks.back().number = number;
  }
  return checks;
}

std::vector<Check> for_each_reading(const std::vector<Check>& checks, const std::string& axis,
                                    const std::vector<std::string>& words) {
  std::vector<Check> out;
  for (const Check& check : checks)
    for (const std::string& word : words) {
      out.push_back(check);
      out.back().reading = word;
      out.back().where.emplace_back(axis, word);
    }
  return out;
}

std::string selection_text(const Selection& selection) {
  return std::visit([](const auto& value) { return shown(Json(value)); }, selection);
}

}  // namespace bristle::experiment
