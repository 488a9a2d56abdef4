#include "experiment/experiment.hpp"

#include "experiment/sample.hpp"
#include "bristle/model/elementary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace bristle::experiment {
namespace {

class AxisReader {
 public:
  AxisReader(const Document& document, const std::string& name)
      : document_(document), at_(JsonPointer("/sweep") / name), name_(name), json_(document.json().at(at_)) {}

  Axis read() {
    sweepable_ = &require_sweepable(document_, at_, name_);
    if (!sweepable_->options.empty()) return {name_, choices()};
    Axis axis{name_, all_values()};
    check_finite(document_, name_, axis.values, [&](std::size_t) { return at_; });
    for (std::size_t i = 1; i < axis.values.size(); ++i)
      if (!(axis.values[i] > axis.values[i - 1]))
        fail(at_,
             fmt::format("the values must ascend, but {} follows {}", axis.values[i], axis.values[i - 1]));
    check_values(document_, name_, axis.values, [&](std::size_t) { return at_; });
    if (json_.contains("take")) axis.values = values_at_taken_indices(axis.values);
    return axis;
  }

 private:
  [[noreturn]] void fail(const JsonPointer& at, const std::string& what) const {
    document_.fail(at.to_string(), what);
  }

  // The values before "take" selects some of them.
  std::vector<double> all_values() const {
    std::vector<std::string> given;
    for (const char* kind : {"values", "linspace", "logspace"})
      if (json_.contains(kind)) given.emplace_back(kind);
    if (given.size() != 1)
      fail(at_, fmt::format("an axis needs exactly one of values, linspace, logspace; found {}",
                            given.empty() ? "none" : fmt::format("{}", fmt::join(given, " and "))));
    if (given[0] == "values") return numbers();
    return range(given[0] == "logspace", at_ / given[0]);
  }

  std::vector<double> numbers() const {
    std::vector<double> values;
    for (const Json& value : json_["values"]) {
      if (!value.is_number()) fail(at_ / "values", fmt::format("{} is not a number", shown(value)));
      values.push_back(value);
    }
    return values;
  }

  // Indices of the given words in the choice's options.
  std::vector<double> choices() const {
    const auto& options = sweepable_->options;
    if (!json_.contains("values") || json_.contains("linspace") || json_.contains("logspace"))
      fail(at_, fmt::format("{} needs \"values\" alone, a list of words; allowed: {}", name_,
                            fmt::join(options, ", ")));
    std::vector<double> indices;
    for (const Json& value : json_["values"]) {
      const double index = option_index(document_, at_ / "values", *sweepable_, value);
      if (std::count(indices.begin(), indices.end(), index))
        fail(at_ / "values", fmt::format("{} appears twice", shown(value)));
      indices.push_back(index);
    }
    return json_.contains("take") ? values_at_taken_indices(indices) : indices;
  }

  std::vector<double> range(bool logarithmic, const JsonPointer& at) const {
    const Json& r = document_.json().at(at);
    const double from = r[0], to = r[1], count = r[2];
    if (count != std::floor(count) || count < 1)
      fail(at, fmt::format("the count {} is not a positive integer", count));
    if (count > kMaxPoints)
      fail(at, fmt::format("{} points; allowed: at most {:.0e} in the sweep", count, kMaxPoints));
    if (logarithmic && !(from > 0))
      fail(at, fmt::format("a logarithmic axis cannot start at {}; allowed: greater than 0", from));
    const auto n = std::size_t(count);
    std::vector<double> values(n, from);
    for (std::size_t i = 1; i < n; ++i) {
      const double share = double(i) / double(n - 1);
      values[i] = logarithmic
                      ? from * pow(to / from, share)
                      : from + (to - from) * double(i) / double(n - 1);  // exact for integers, unlike share
    }
    if (n > 1) values.back() = to;
    return values;
  }

  std::vector<double> values_at_taken_indices(const std::vector<double>& values) const {
    std::vector<double> kept;
    long last = -1;
    for (const long index : json_["take"]) {
      if (index <= last || index >= long(values.size()))
        fail(at_ / "take", fmt::format("{} is not allowed; allowed: ascending indices from 0 to {}", index,
                                       values.size() - 1));
      kept.push_back(values[std::size_t(index)]);
      last = index;
    }
    return kept;
  }

  const Document& document_;
  JsonPointer at_;
  std::string name_;
  const Json& json_;
  const Sweepable* sweepable_ = nullptr;
};

}  // namespace

std::vector<Axis> read_axes(const Document& document) {
  std::vector<Axis> axes;
  if (!document.json().contains("sweep")) return axes;
  double points = 1;
  for (const auto& [name, json] : document.json()["sweep"].items()) {
    axes.push_back(name == kSample ? read_sample(document) : AxisReader(document, name).read());
    for (const Axis& column : axes.back().columns)
      if (document.json()["sweep"].contains(column.name))
        document.fail("/sweep/sample", column.name + " is varied by another axis, too; remove one of them");
    points *= double(axes.back().values.size());
    if (points > kMaxPoints) {
      document.fail("/sweep",
                    fmt::format("{:.3g} points or more; allowed: at most {:.0e}", points, kMaxPoints));
    }
  }
  return axes;
}

}  // namespace bristle::experiment
