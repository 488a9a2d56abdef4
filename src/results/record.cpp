#include "results/record.hpp"

#include "bristle/ensemble/phase.hpp"
#include "bristle/ensemble/validity.hpp"
#include "bristle/model/lift_off.hpp"
#include "results/reader.hpp"
#include "util/error.hpp"
#include "util/sha.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <limits>

namespace bristle::results {
namespace {

// Makes all NaN the same, because the sign of a computed NaN depends on processor and compiler.
void unify_nan(std::vector<double>& numbers) {
  for (double& x : numbers)
    if (std::isnan(x)) x = std::numeric_limits<double>::quiet_NaN();
}

PointRecord with_unified_nan(PointRecord record) {
  unify_nan(record.values);
  for (Rows& rows : record.tables)
    for (auto& column : rows) unify_nan(column);
  return record;
}

// Returns the rows of a table that belong to one point. Requires that the table is sorted by points.
Rows read_rows(const ResultReader& result, const std::string& table, std::size_t index) {
  const std::vector<double>& points = result.variable(table + "/point").values;
  const auto [from, to] = std::equal_range(points.begin(), points.end(), double(index));
  Rows rows;
  for (const Column& column : table_columns(table)) {
    const std::vector<double>& values = result.variable(table + "/" + column.name).values;
    if (values.size() != points.size())
      throw RunError(fmt::format("{}/{} has {} rows, but {}/point has {}", table, column.name, values.size(),
                                 table, points.size()));
    rows.emplace_back(values.begin() + (from - points.begin()), values.begin() + (to - points.begin()));
  }
  return rows;
}

bool same(const Rows& a, const Rows& b) {
  return std::ranges::equal(a, b,
                            [](const auto& x, const auto& y) { return std::ranges::equal(x, y, same_bits); });
}

}  // namespace

PointLayout::PointLayout(const Sweep& sweep) {
  const Loading& loading = sweep.base.loading;
  const bool searched = !loading.z_0;
  if (searched) groups.emplace_back("load_error");
  for (const ResultVariable& variable : result_variables(sweep)) add(variable, searched);
  const auto add_number = [&](Column column, auto value) {
    variables.push_back(std::move(column));
    append_.push_back(
        [value](const PointResult& p, std::vector<double>& out) { out.push_back(double(value(p))); });
  };
  add_number({"passages", "number of passages computed for the point", "N", "", Number::integer},
             [](const PointResult& p) { return p.passages; });
  const auto add_code = [&](const std::string& name, const std::string& long_name, Words meanings,
                            auto value) {
    add_number({name, long_name, "", "", Number::code, texts(meanings)}, value);
  };
  add_code("status", "outcome of the point", words<PointStatus>(),
           [](const PointResult& p) { return p.status; });
  add_code("start", "whether bristles bend or are crushed as the slab comes down", words<Start>(),
           [](const PointResult& p) { return p.start; });
  add_code("phase", "whether tips stay on the slab or bounce", words<BrushPhase>(),
           [](const PointResult& p) { return phase_of(p); });
  if (sweep.base.setup.orientation.distribution != Distribution::von_mises) {  // as lift_off_load
    add_code("lift_off_domain", "whether the formula of lift_off_load was tested here, or what is outside",
             words<LiftOffDomain>(), [](const PointResult& p) { return lift_off_domain(p.parameters); });
    variables.back().equation = "docs/lift-off.md";
  }
  for (const ValidityRow& row : kValidity)
    add_code(row.name, row.meaning, words<Exceeds>(),
             [&row](const PointResult& p) { return exceeds(row, p); });
  if (sweep.record.bristles) tables.emplace_back("bristles");
  if (!sweep.record.trajectories.empty()) tables.emplace_back("trajectories");
  if (sweep.record.slab_force) tables.emplace_back("slab_force");
  std::string names;
  for (const Column& variable : variables) {
    numbers_.emplace(variable.name, numbers_.size());
    names += variable.name + ",";
  }
  for (const std::string& table : tables)
    for (const Column& column : table_columns(table)) names += fmt::format("{}/{},", table, column.name);
  digest_ = sha256_of(names).substr(0, 16);
}

// Adds the variable, its error and, if the gap was searched for, the part of the error due to the load.
void PointLayout::add(const ResultVariable& variable, bool searched) {
  std::vector<double Quantity::*> parts;
  const auto add_part = [&](const Column& column, double Quantity::*part) {
    variables.push_back(column);
    parts.push_back(part);
  };
  Column column = variable;
  column.ancillary = variable.errors == Errors::none ? "status" : variable.name + "_err status";
  add_part(column, &Quantity::value);
  column.ancillary = "";
  column.symbol = R"(\delta )" + variable.symbol;
  if (searched && variable.errors == Errors::with_load) {
    column.name = "load_error/" + variable.name;
    column.long_name = "part of " + variable.name + "_err due to the deviation of the load from its target";
    add_part(column, &Quantity::load_error);
  }
  column.name = variable.name + "_err";
  column.long_name = "estimated numerical error of " + variable.name;
  if (variable.errors != Errors::none) add_part(column, &Quantity::error);
  append_.push_back([of = variable.of, parts](const PointResult& p, std::vector<double>& out) {
    const Quantity quantity = of(p);
    for (const auto part : parts) out.push_back(quantity.*part);
  });
}

std::vector<double> PointLayout::values_of(const PointResult& point) const {
  std::vector<double> out;
  out.reserve(variables.size());
  for (const Append& append : append_) append(point, out);
  return out;
}

Layout layout_of(const Sweep& sweep) { return std::make_shared<const PointLayout>(sweep); }

std::string why_missing(const PointRecord& record, const ResultVariable& variable) {
  if (variable.name.find("lift_off") != std::string::npos && record.layout->has("lift_off_domain"))
    if (const auto domain = LiftOffDomain(std::lround(record.at("lift_off_domain")));
        domain != LiftOffDomain::tested)
      return outside_of(domain);
  if (PointStatus(std::lround(record.at("status"))) == PointStatus::undefined)
    return "it is a ratio to a load or friction of zero";
  return variable.why_missing;
}

PointRecord record_of(const Layout& layout, const PointResult& result, const Recorded& recorded) {
  PointRecord record{layout, layout->values_of(result)};
  for (const std::string& table : layout->tables) record.tables.push_back(table_rows(table, recorded));
  return with_unified_nan(std::move(record));
}

PointRecord failed_record(const Layout& layout, const std::string& error) {
  PointRecord record = record_of(layout, without_values(PointStatus::failed), {});
  record.failure = error;
  return record;
}

PointRecord read_record(const ResultReader& result, const Sweep& sweep, std::size_t index) {
  const Layout layout = layout_of(sweep);
  const std::vector<std::size_t> shape = sweep.shape();
  PointRecord record{layout};
  for (const Column& variable : layout->variables) {
    const Array& array = result.variable(variable.name);
    if (array.shape != shape)
      throw RunError(fmt::format("{} has the shape ({}), but the sweep has ({})", variable.name,
                                 fmt::join(array.shape, ", "), fmt::join(shape, ", ")));
    record.values.push_back(array.values[index]);
  }
  for (const std::string& table : layout->tables) record.tables.push_back(read_rows(result, table, index));
  const auto failures = result.failures();
  if (const auto failure = failures.find(failure_name(index)); failure != failures.end())
    record.failure = failure->second;
  return with_unified_nan(std::move(record));
}

std::string failure_name(std::size_t index) { return fmt::format("point_{}", index); }

bool is_consistent(const PointRecord& record) {
  const PointLayout& layout = *record.layout;
  if (record.values.size() != layout.variables.size() || record.tables.size() != layout.tables.size())
    return false;
  for (std::size_t i = 0; i < record.tables.size(); ++i) {
    const Rows& rows = record.tables[i];
    if (rows.size() != table_columns(layout.tables[i]).size()) return false;
    for (const auto& column : rows)
      if (column.size() != rows.front().size()) return false;
  }
  const double status = record.at("status");
  return status >= 0 && status < double(words<PointStatus>().size()) && status == std::floor(status);
}

std::vector<std::string> differences(const PointRecord& a, const PointRecord& b) {
  const PointLayout& layout = *a.layout;
  std::vector<std::string> out;
  for (std::size_t i = 0; i < layout.variables.size(); ++i)
    if (!same_bits(a.values[i], b.values[i])) out.push_back(layout.variables[i].name);
  for (std::size_t i = 0; i < layout.tables.size(); ++i)
    if (!same(a.tables[i], b.tables[i])) out.push_back(layout.tables[i]);
  return out;
}

}  // namespace bristle::results
