#include "results/dataset.hpp"

#include "util/grid.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace bristle::results {
namespace {

const Array& find(const std::vector<Array>& arrays, const std::string& name) {
  const auto found = std::ranges::find(arrays, name, [](const Array& array) { return array.about.name; });
  if (found == arrays.end()) throw std::out_of_range("there is no array " + name);
  return *found;
}

std::vector<double> counted(std::size_t count) {
  std::vector<double> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0.0);
  return numbers;
}

}  // namespace

std::string Array::text(double value) const {
  if (value >= 0 && value < double(about.words.size()) && value == std::floor(value))
    return about.words[std::size_t(value)];
  return fmt::format("{}", value);
}

std::string Array::cell(std::size_t i) const {
  const double value = values.at(i);
  return std::isnan(value) ? "" : text(value);
}

Array coordinates(const Column& about, std::vector<double> values) {
  const std::size_t size = values.size();
  return {about, {about.name}, {size}, std::move(values), true};
}

Array coordinates(const std::string& name, const std::string& meaning,
                  const std::vector<std::string>& words) {
  return coordinates({name, meaning, "", "", Number::code, words}, counted(words.size()));
}

Array row_numbers(const std::string& name, const std::string& meaning, std::size_t count) {
  return coordinates({name, meaning, "", "", Number::integer}, counted(count));
}

void Dataset::add_dimension(Array coordinates) { dimensions_.push_back(std::move(coordinates)); }

void Dataset::add_axis(const std::string& name, std::size_t size) {
  dimensions_.push_back({{.name = name}, {name}, {size}, {}, true});
}

const Array& Dataset::array(const std::string& name) const { return find(arrays_, name); }

const Array& Dataset::dimension(const std::string& name) const { return find(dimensions_, name); }

std::vector<std::size_t> Dataset::shape() const {
  std::vector<std::size_t> out;
  for (const Array& dimension : dimensions_) out.push_back(dimension.shape.front());
  return out;
}

std::size_t Dataset::size() const { return grid_size(shape()); }

void Dataset::add(Array array) {
  Array& added = add_array(std::move(array.about));
  if (array.values.size() != size())
    throw std::out_of_range(
        fmt::format("{}: {} values, not {}", added.about.name, array.values.size(), size()));
  added.values = std::move(array.values);
}

Array& Dataset::add_array(Column about) {
  std::vector<std::string> names;
  for (const Array& dimension : dimensions_) names.push_back(dimension.about.name);
  return arrays_.emplace_back(Array{std::move(about), std::move(names), shape(), {}, false});
}

void Dataset::add_word(Array& array, const std::string& text) {
  array.about.number = Number::text;
  array.values.push_back(double(array.about.words.size()));
  array.about.words.push_back(text);
}

bool same_bits(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  return a == b && std::signbit(a) == std::signbit(b);
}

}  // namespace bristle::results
