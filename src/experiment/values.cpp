#include "experiment/values.hpp"

#include "experiment/schema.hpp"
#include "util/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

namespace bristle::experiment {

void check_finite(const std::string& quantity, const std::vector<double>& values, const PlaceOf& place) {
  if (const auto wrong = std::ranges::find_if_not(values, [](double v) { return std::isfinite(v); });
      wrong != values.end())
    place(std::size_t(wrong - values.begin()))
        .fail(fmt::format("the values of {}, or the width or ratio of their range, are beyond the largest "
                          "number, 1.8e308; give a narrower range",
                          quantity));
}

void check_values(const std::string& quantity, const std::vector<double>& values, const PlaceOf& place) {
  if (!sweep::find_sweepable(quantity)->options.empty()) return;  // option_index() has found the words
  check_finite(quantity, values, place);
  const auto check = [&](auto value) {
    if (value != values.end()) check_parameter(place(std::size_t(value - values.begin())), quantity, *value);
  };
  check(std::ranges::min_element(values));
  check(std::ranges::max_element(values));
  check(std::ranges::find_if(values, [](double v) { return v != std::floor(v); }));
}

void require_distinct(const json::Node& range, double low, double high, std::size_t count) {
  const double size = std::max(std::abs(low), std::abs(high));
  double digit = 1e-6;  // the seventh
  for (double rest = size; rest >= 10; rest /= 10) digit *= 10;
  for (double rest = size; rest < 1 && rest > 0; rest *= 10) digit /= 10;
  const double values = std::floor((high - low) / digit * (1 + 1e-9)) + 1;
  if (values >= double(count)) return;
  range.fail(
      fmt::format("the range from {} to {} has {} value{} of seven digits, to which values are "
                  "rounded, for {} points; give a wider one",
                  low, high, values, values == 1 ? "" : "s", count));
}

double option_index(const json::Node& place, const sweep::Sweepable& choice, const Json& word) {
  const auto& options = choice.options;
  const std::string text = word.is_string() ? word.get<std::string>() : shown(word);
  const auto found = std::ranges::find(options, text);
  if (found == options.end())
    place.fail(fmt::format("{} is not known{}; allowed: {}", shown(word), did_you_mean(text, options),
                           fmt::join(options, ", ")));
  return double(found - options.begin());
}

const sweep::Sweepable& require_sweepable(const json::Node& place, const std::string& name) {
  if (const sweep::Sweepable* sweepable = sweep::find_sweepable(name)) return *sweepable;
  std::vector<std::string> known;
  for (const sweep::Sweepable& sweepable : sweep::sweepables()) known.push_back(sweepable.name);
  place.fail(fmt::format("{} cannot be swept{}; allowed: {}", name, did_you_mean(name, known),
                         fmt::join(known, ", ")));
}

}  // namespace bristle::experiment
