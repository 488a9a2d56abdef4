#include "compare/comparison.hpp"

#include "util/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <string_view>
#include <unordered_map>

namespace bristle::compare {
namespace {

using results::Array;
using results::Number;

// Maps the dimensions of b to the dimensions of a. A dimension whose coordinates are equal is in neither
// member.
struct Matches {
  std::map<std::string, std::vector<std::size_t>> index;  // index in a of each value of b
  std::set<std::string> different;                        // b has values that a does not have
};

bool same_kind(const Array& a, const Array& b) {
  if (a.coordinate || b.coordinate) return a.coordinate == b.coordinate;
  return a.about.number == b.about.number;
}

// Returns the names that are on both sides. Other names become failures.
std::vector<std::string> common_names(const Side& a, const Side& b, Comparison& out) {
  std::vector<std::string> both;
  for (const auto& [name, array] : a.arrays)
    if (!b.arrays.contains(name)) out.failures.push_back(fmt::format("{}: only in {}", name, a.label));
    else if (same_kind(*array, *b.arrays.at(name))) both.push_back(name);
    else out.failures.push_back(fmt::format("{}: different kinds of numbers", name));
  for (const auto& [name, array] : b.arrays)
    if (!a.arrays.contains(name)) out.failures.push_back(fmt::format("{}: only in {}", name, b.label));
  return both;
}

// Returns the bits of a number, which are equal for numbers that are the same by same_bits().
std::uint64_t bits_of(double x) {
  return std::bit_cast<std::uint64_t>(std::isnan(x) ? std::numeric_limits<double>::quiet_NaN() : x);
}

void match_coordinates(const std::string& name, const Side& a, const Side& b, Matches& matches,
                       Comparison& out) {
  const std::vector<double>&in_a = a.arrays.at(name)->values, &in_b = b.arrays.at(name)->values;
  if (std::ranges::equal(in_a, in_b, results::same_bits)) return;
  const std::string dimension = name.substr(name.rfind('/') + 1);
  std::vector<std::size_t> index;
  std::unordered_map<std::uint64_t, std::size_t> index_in_a;
  for (std::size_t i = 0; i < in_a.size(); ++i) index_in_a.try_emplace(bits_of(in_a[i]), i);
  for (const double value : in_b) {
    const auto found = index_in_a.find(bits_of(value));
    if (found == index_in_a.end()) {
      out.failures.push_back(
          fmt::format("{}: different coordinates: {} of {} is not among the {} values of {}", name, value,
                      b.label, in_a.size(), a.label));
      matches.different.insert(dimension);
      return;
    }
    index.push_back(found->second);
  }
  out.subsets.push_back(fmt::format("{}: different coordinates: {} values in {}, {} of them in {}", name,
                                    in_a.size(), a.label, in_b.size(), b.label));
  matches.index[dimension] = index;
}

// Returns the bits of the values of each row of a sample, by ascending name of the columns.
std::vector<std::string> rows_of(const std::map<std::string, const Array*>& columns) {
  std::vector<std::string> rows;
  for (const auto& [name, column] : columns) {
    rows.resize(column->values.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::uint64_t bits = bits_of(column->values[i]);
      rows[i].append(reinterpret_cast<const char*>(&bits), sizeof bits);
    }
  }
  return rows;
}

std::vector<std::string> names_of(const std::vector<const Array*>& columns) {
  std::vector<std::string> names;
  for (const Array* column : columns) names.push_back(column->about.name);
  return names;
}

// Returns a text such as "row 3 (k_r = 2, friction = nss)".
std::string row_text(const std::vector<const Array*>& columns, std::size_t row) {
  std::vector<std::string> values;
  for (const Array* column : columns)
    values.push_back(fmt::format("{} = {}", column->about.name, column->text(column->values[row])));
  return fmt::format("row {} ({})", row, fmt::join(values, ", "));
}

std::map<std::string, const Array*> by_name(const std::vector<const Array*>& columns) {
  std::map<std::string, const Array*> out;
  for (const Array* column : columns) out[column->about.name] = column;
  return out;
}

// Dimensions of which the number of a row says nothing where samples differ: rows of the sample, and trials
// of a design, which are rows of its sample.
const std::set<std::string> kNumberedBySample = {sweep::kSample, "trial"};

// Finds the rows of a sample by their values, because row numbers do not identify them.
void match_rows(const Side& a, const Side& b, Matches& matches, Comparison& out) {
  constexpr std::size_t most_named = 3;
  const std::string sample = sweep::kSample;
  const auto columns_a = by_name(*a.sample), columns_b = by_name(*b.sample);
  const auto same_name = [](const auto& x, const auto& y) { return x.first == y.first; };
  if (!std::ranges::equal(columns_a, columns_b, same_name)) {
    out.failures.push_back(fmt::format("{}: different columns: {} in {}, {} in {}", sample,
                                       fmt::join(names_of(*a.sample), ", "), a.label,
                                       fmt::join(names_of(*b.sample), ", "), b.label));
    matches.different.insert(kNumberedBySample.begin(), kNumberedBySample.end());
    return;
  }
  const std::vector<std::string> in_a = rows_of(columns_a), in_b = rows_of(columns_b);
  if (in_a == in_b) return;
  std::unordered_map<std::string_view, std::size_t> row_in_a;
  for (std::size_t i = 0; i < in_a.size(); ++i) row_in_a.try_emplace(in_a[i], i);
  std::vector<const Array*> in_order_of_a;
  for (const std::string& name : names_of(*a.sample)) in_order_of_a.push_back(columns_b.at(name));
  std::vector<std::size_t> index;
  std::vector<std::string> named;
  for (std::size_t i = 0; i < in_b.size(); ++i)
    if (const auto found = row_in_a.find(in_b[i]); found != row_in_a.end()) index.push_back(found->second);
    else if (named.size() < most_named) named.push_back(row_text(in_order_of_a, i));
  if (const std::size_t missing = in_b.size() - index.size(); missing > 0) {
    out.failures.push_back(
        fmt::format("{}: different rows: {} of the {} rows of {} are not among the {} rows of {}: {}{}",
                    sample, missing, in_b.size(), b.label, in_a.size(), a.label, fmt::join(named, ", "),
                    missing > named.size() ? ", ..." : ""));
    matches.different.insert(kNumberedBySample.begin(), kNumberedBySample.end());
    return;
  }
  if (in_a.size() == in_b.size())
    out.notes.push_back(fmt::format(
        "{}: the rows of {} have another order; they are compared by their values", sample, b.label));
  else
    out.subsets.push_back(fmt::format("{}: different rows: {} in {}, {} of them in {}", sample, in_a.size(),
                                      a.label, in_b.size(), b.label));
  matches.index[sample] = index;
}

std::string shape_text(const Array& n) {
  if (n.shape.empty()) return "a single value";
  return fmt::format("{} over {}", fmt::join(n.shape, " x "), fmt::join(n.dimensions, " x "));
}

// Returns why two variables cannot be compared; empty if they can be.
std::string mismatch(const Array& a, const Array& b, const Matches& matches) {
  std::string shapes = fmt::format("different shapes: {} against {}", shape_text(a), shape_text(b));
  if (a.dimensions != b.dimensions || a.shape.size() != b.shape.size()) return shapes;
  for (std::size_t d = 0; d < a.shape.size(); ++d) {
    const std::string& dimension = a.dimensions[d];
    if (matches.different.contains(dimension))
      return fmt::format("not compared, because the coordinates of {} differ", dimension);
    const auto found = matches.index.find(dimension);
    if (found == matches.index.end() && a.shape[d] == b.shape[d]) continue;
    if (found == matches.index.end() || b.shape[d] != found->second.size() ||
        std::ranges::any_of(found->second, [&](std::size_t i) { return i >= a.shape[d]; }))
      return shapes;
  }
  return "";
}

// Returns the index in a of each value of b.
std::vector<std::size_t> indices(const Array& a, const Array& b, const Matches& matches) {
  std::vector<std::size_t> out = {0};
  for (std::size_t d = 0; d < b.shape.size(); ++d) {
    const auto found = matches.index.find(b.dimensions[d]);
    std::vector<std::size_t> longer;
    longer.reserve(out.size() * b.shape[d]);
    for (const std::size_t before : out)
      for (std::size_t i = 0; i < b.shape[d]; ++i)
        longer.push_back(before * a.shape[d] + (found == matches.index.end() ? i : found->second[i]));
    out = std::move(longer);
  }
  return out;
}

// Returns the sum of the tolerances of both sides; NaN if it is unknown. at: the index in a of each value of
// b
std::vector<double> tolerances_of(const std::string& name, const Side& a, const Side& b,
                                  const std::vector<std::size_t>& at, const Tolerances& given) {
  std::vector<double> out(at.size(), std::numeric_limits<double>::quiet_NaN());
  const std::vector<double>&in_a = a.arrays.at(name)->values, &in_b = b.arrays.at(name)->values;
  const auto tolerance_a = a.tolerances.find(name), tolerance_b = b.tolerances.find(name);
  for (std::size_t j = 0; j < out.size(); ++j)
    if (given.given())
      out[j] = given.atol.value_or(0) +
               given.rtol.value_or(0) * std::max(std::abs(in_a[at[j]]), std::abs(in_b[j]));
    else if (tolerance_b != b.tolerances.end())
      out[j] =
          (*tolerance_b->second)[j] + (tolerance_a == a.tolerances.end() ? 0 : (*tolerance_a->second)[at[j]]);
  return out;
}

// Adds a pair of values that differ. Returns true if their difference is the worst so far.
bool add(Difference& d, double a, double b, double tolerance, bool has_size,
         std::pair<double, double>& worst) {
  const double size = has_size ? std::abs(a - b) : INFINITY;
  const double in_tolerances = size == 0 ? 0 : has_size ? size / tolerance : INFINITY;
  ++d.values;
  d.above_half += !(in_tolerances <= 0.5);
  d.above += !(in_tolerances <= 1);
  if (has_size && size > 0) {
    d.absolute = std::max(d.absolute, size);
    d.relative = std::max(d.relative, size / std::max(std::abs(a), std::abs(b)));
  }
  const std::pair rank{std::isnan(in_tolerances) ? -1 : in_tolerances, size};
  if (d.values > 1 && rank <= worst) return false;
  worst = rank;
  d.tolerances = in_tolerances;
  return true;
}

void compare_values(const std::string& name, const results::ResultReader& result, const Array& a,
                    const Array& b, const std::vector<std::size_t>& at, const std::vector<double>& tolerances,
                    Comparison& out) {
  Difference d;
  d.name = name;
  std::pair<double, double> worst;
  std::size_t in_b = 0;
  for (std::size_t j = 0; j < at.size(); ++j) {
    const double x = a.values[at[j]], y = b.values[j];
    const bool has_size = a.about.number != Number::code && std::isfinite(x) && std::isfinite(y);
    if (!results::same_bits(x, y) && add(d, x, y, tolerances[j], has_size, worst)) in_b = j;
  }
  out.values += at.size();
  if (d.values == 0) return;
  d.where = at[in_b];
  d.place = results::place(result, name, d.where);
  d.a = a.text(a.values[d.where]);
  d.b = a.text(b.values[in_b]);
  out.differences.push_back(d);
}

void check_tolerance(const char* option, const std::optional<double>& value) {
  if (value && !(*value >= 0 && std::isfinite(*value)))
    throw InputError(fmt::format("{} {} is not allowed; allowed: 0 or a positive number", option, *value));
}

// Returns all numeric datasets of a result, with the estimated errors as tolerances.
Side whole_file(const results::ResultReader& result) {
  Side side{result.path()};
  for (const std::string& name : result.datasets()) {
    side.arrays[name] = &result.variable(name);
    if (!result.has(name + "_err")) continue;
    const std::vector<double>& errors = result.variable(name + "_err").values;
    if (errors.size() == side.arrays[name]->values.size()) side.tolerances[name] = &errors;
  }
  side.sample.emplace();
  for (const std::string& name : result.sample_columns()) side.sample->push_back(&result.variable(name));
  return side;
}

}  // namespace

std::size_t Comparison::total(std::size_t Difference::*count) const {
  std::size_t sum = 0;
  for (const Difference& d : differences) sum += d.*count;
  return sum;
}

bool Comparison::agree() const {
  return failures.empty() && (exact ? differences.empty() : total(&Difference::above) == 0);
}

Comparison compare_sides(const results::ResultReader& result, const Side& a, const Side& b,
                         const Tolerances& tolerances) {
  Comparison out;
  out.label = b.label;
  const std::vector<std::string> names = common_names(a, b, out);
  Matches matches;
  for (const std::string& name : names)
    if (name == sweep::kSample && a.sample && b.sample) match_rows(a, b, matches, out);
    else if (a.arrays.at(name)->coordinate) match_coordinates(name, a, b, matches, out);
  std::map<std::string, std::vector<std::string>> not_compared;  // names, by reason
  for (const std::string& name : names) {
    const Array &in_a = *a.arrays.at(name), &in_b = *b.arrays.at(name);
    if (in_a.coordinate) continue;
    if (const std::string reason = mismatch(in_a, in_b, matches); !reason.empty()) {
      not_compared[reason].push_back(name);
      continue;
    }
    const auto at = indices(in_a, in_b, matches);
    compare_values(name, result, in_a, in_b, at, tolerances_of(name, a, b, at, tolerances), out);
    if (name == "status") out.points = in_b.values.size(), out.points_in_file = in_a.values.size();
  }
  for (const auto& [reason, which] : not_compared)
    out.failures.push_back(
        fmt::format("{}{}: {}", which[0],
                    which.size() > 1 ? fmt::format(" and {} more variables", which.size() - 1) : "", reason));
  const auto rank = [](const Difference& d) {
    return std::pair(std::isnan(d.tolerances) ? -1 : d.tolerances, d.relative);
  };
  std::ranges::stable_sort(out.differences, std::greater(), rank);
  return out;
}

Comparison diff_results(const results::ResultReader& a, const results::ResultReader& b,
                        const Tolerances& tolerances) {
  check_tolerance("--rtol", tolerances.rtol);
  check_tolerance("--atol", tolerances.atol);
  Comparison out = compare_sides(a, whole_file(a), whole_file(b), tolerances);
  out.exact = !tolerances.given();
  out.failures.insert(out.failures.begin(), out.subsets.begin(), out.subsets.end());
  if (const auto x = a.text("name"), y = b.text("name"); x != y)
    out.notes.push_back(fmt::format("different experiments: {} and {}", x, y));
  return out;
}

}  // namespace bristle::compare
