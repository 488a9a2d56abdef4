#include "compare/diff.hpp"

#include "compare/comparison.hpp"
#include "results/datasets.hpp"
#include "util/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace bristle::compare {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

struct Pair {
  const results::ResultReader &a, &b;
};

void check_tolerance(const char* option, const std::optional<double>& value) {
  if (value && !(*value >= 0 && std::isfinite(*value)))
    throw InputError(fmt::format("{} {} is not allowed; allowed: 0 or a positive number", option, *value));
}

std::string shape_text(const results::Variable& v) {
  if (v.shape.empty()) return "a single value";
  return fmt::format("{} over {}", fmt::join(v.shape, " x "), fmt::join(v.dimensions, " x "));
}

// Names that are in both files. Names that are in one file only are differences.
std::vector<std::string> common_names(const Pair& files, Diff& out) {
  const auto in_a = results::numeric_datasets(files.a), in_b = results::numeric_datasets(files.b);
  const auto has = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  std::vector<std::string> both;
  for (const std::string& name : in_a)
    if (has(in_b, name)) both.push_back(name);
    else out.incomparable.push_back(fmt::format("{}: only in {}", name, files.a.path()));
  for (const std::string& name : in_b)
    if (!has(in_a, name)) out.incomparable.push_back(fmt::format("{}: only in {}", name, files.b.path()));
  return both;
}

// The first difference of two axes or row numbers; empty if they are equal.
std::string coordinate_difference(const results::Variable& a, const results::Variable& b) {
  if (a.shape != b.shape)
    return fmt::format("different coordinates: {} values against {}", a.values.size(), b.values.size());
  for (std::size_t i = 0; i < a.values.size(); ++i)
    if (!results::same_bits(a.values[i], b.values[i]))
      return fmt::format("different coordinates: {} against {} at index {}", a.values[i], b.values[i], i);
  return "";
}

// Names of the dimensions whose coordinates differ, so that equal indices are different points.
std::set<std::string> compare_coordinates(const Pair& files, const std::vector<std::string>& names,
                                          Diff& out) {
  std::set<std::string> different;
  for (const std::string& name : names) {
    if (results::kind_of(files.a, name) != results::DatasetKind::coordinate ||
        results::kind_of(files.b, name) != results::DatasetKind::coordinate)
      continue;
    ++out.compared;
    const std::string how = coordinate_difference(files.a.variable(name), files.b.variable(name));
    if (how.empty()) {
      ++out.same;
      continue;
    }
    out.incomparable.push_back(fmt::format("{}: {}", name, how));
    different.insert(name.substr(name.rfind('/') + 1));
  }
  return different;
}

// The unit of the differences of a variable: the tolerance or, if none is given, the sum of both error
// estimates. NaN without error estimates.
std::vector<double> units_of(const Pair& files, const std::string& name, const results::Variable& a,
                             const results::Variable& b, const Tolerances& tolerances) {
  std::vector<double> units(a.values.size(), kUnknown);
  if (tolerances.given()) {
    for (std::size_t i = 0; i < units.size(); ++i)
      units[i] = tolerances.atol.value_or(0) +
                 tolerances.rtol.value_or(0) * std::max(std::abs(a.values[i]), std::abs(b.values[i]));
    return units;
  }
  const std::string error = name + "_err";
  if (!files.a.has(error) || !files.b.has(error)) return units;
  const auto in_a = files.a.variable(error).values, in_b = files.b.variable(error).values;
  if (in_a.size() == units.size() && in_b.size() == units.size())
    for (std::size_t i = 0; i < units.size(); ++i) units[i] = in_a[i] + in_b[i];
  return units;
}

// Reports differences of flags, NaN and infinity, which have no size: the first of them and their number.
void report_without_size(const Pair& files, const std::string& name, const results::Variable& a,
                         const results::Variable& b, const std::vector<std::size_t>& at, Diff& out) {
  if (at.empty()) return;
  const std::size_t i = at[0];
  out.incomparable.push_back(
      fmt::format("{}: {} against {} at {}{}", name, results::value_text(files.a, name, a.values[i]),
                  results::value_text(files.b, name, b.values[i]), results::place(files.a, name, i),
                  at.size() > 1 ? fmt::format(", and {} more", at.size() - 1) : ""));
}

void compare_values(const Pair& files, const std::string& name, const results::Variable& a,
                    const results::Variable& b, Diff& out) {
  const bool flags = results::kind_of(files.a, name) == results::DatasetKind::flags;
  const auto units = units_of(files, name, a, b, out.tolerances);
  Difference d;
  d.name = name;
  std::vector<std::size_t> without_size, with_size;
  std::pair<double, double> worst;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const double x = a.values[i], y = b.values[i];
    if (results::same_bits(x, y)) continue;
    const bool has_size = !flags && std::isfinite(x) && std::isfinite(y);
    (has_size ? with_size : without_size).push_back(i);
    if (!has_size) continue;
    const double size = std::abs(x - y), in_units = in_tolerances(x, y, units[i]);
    d.absolute = std::max(d.absolute, size);
    if (size > 0) d.relative = std::max(d.relative, size / std::max(std::abs(x), std::abs(y)));
    if (!std::isnan(in_units)) d.units = std::max(d.units.value_or(0), in_units);
    const std::pair<double, double> rank{std::isnan(in_units) ? -1 : in_units, size};
    if (with_size.size() > 1 && rank <= worst) continue;
    worst = rank;
    d.a = x;
    d.b = y;
    d.where = i;
  }
  report_without_size(files, name, a, b, without_size, out);
  if (without_size.empty() && with_size.empty()) ++out.same;
  if (with_size.empty()) return;
  d.place = results::place(files.a, name, d.where);
  out.numbers.push_back(d);
}

void compare_variables(const Pair& files, const std::vector<std::string>& names,
                       const std::set<std::string>& different_dimensions, Diff& out) {
  std::map<std::string, int> skipped;  // number of variables, by dimension
  for (const std::string& name : names) {
    const results::DatasetKind kind = results::kind_of(files.a, name);
    const bool same_kind = kind == results::kind_of(files.b, name);
    if (kind == results::DatasetKind::coordinate && same_kind) continue;
    ++out.compared;
    const results::Variable a = files.a.variable(name), b = files.b.variable(name);
    const auto different = std::find_if(a.dimensions.begin(), a.dimensions.end(), [&](const std::string& d) {
      return different_dimensions.contains(d);
    });
    if (!same_kind) out.incomparable.push_back(fmt::format("{}: different kinds of numbers", name));
    else if (a.dimensions == b.dimensions && different != a.dimensions.end()) ++skipped[*different];
    else if (a.shape != b.shape || a.dimensions != b.dimensions)
      out.incomparable.push_back(
          fmt::format("{}: different shapes: {} against {}", name, shape_text(a), shape_text(b)));
    else compare_values(files, name, a, b, out);
  }
  for (const auto& [dimension, count] : skipped)
    out.incomparable.push_back(fmt::format(
        "{} variables over {} are not compared, because its coordinates differ", count, dimension));
}

std::string table(const std::vector<Difference>& numbers) {
  std::size_t width = 8;
  for (const Difference& d : numbers) width = std::max(width, d.name.size());
  std::string text = fmt::format("{:<{}}  {:>12} {:>12} {:>12}  {}\n", "variable", width, "difference",
                                 "relative", "tolerances", "worst at");
  for (const Difference& d : numbers)
    text += fmt::format("{:<{}}  {:>12.3g} {:>12.3g} {:>12}  {}: {} against {}\n", d.name, width, d.absolute,
                        d.relative, d.units ? fmt::format("{:.3g}", *d.units) : "-", d.place, d.a, d.b);
  return text;
}

}  // namespace

double Diff::worst() const {
  double largest = 0;
  for (const Difference& d : numbers) largest = std::max(largest, d.units.value_or(INFINITY));
  return largest;
}

bool Diff::agree() const {
  if (!incomparable.empty()) return false;
  return tolerances.given() ? worst() <= 1 : numbers.empty();
}

Diff diff_results(const results::ResultReader& a, const results::ResultReader& b,
                  const Tolerances& tolerances) {
  check_tolerance("--rtol", tolerances.rtol);
  check_tolerance("--atol", tolerances.atol);
  const Pair files{a, b};
  Diff out;
  out.tolerances = tolerances;
  if (const auto x = a.text("name"), y = b.text("name"); x != y)
    out.notes.push_back(fmt::format("different experiments: {} and {}", x, y));
  const auto names = common_names(files, out);
  compare_variables(files, names, compare_coordinates(files, names, out), out);
  const auto rank = [](const Difference& d) { return std::pair(d.units.value_or(-1), d.relative); };
  std::stable_sort(out.numbers.begin(), out.numbers.end(),
                   [&](const Difference& x, const Difference& y) { return rank(x) > rank(y); });
  return out;
}

std::string diff_text(const Diff& diff) {
  std::string text;
  for (const std::string& note : diff.notes) text += note + "\n";
  if (diff.agree() && diff.numbers.empty())
    return text + fmt::format("the same, bit for bit: {} variables\n", diff.compared);
  if (diff.agree())
    return text +
           fmt::format(
               "within the tolerances: {} variables, {} of them the same bit for bit, the rest up to {:.3g} "
               "of the tolerance\n",
               diff.compared, diff.same, diff.worst());
  for (const std::string& line : diff.incomparable) text += line + "\n";
  if (!diff.numbers.empty()) text += table(diff.numbers);
  return text + fmt::format("{} of {} variables are the same bit for bit\n", diff.same, diff.compared);
}

}  // namespace bristle::compare
