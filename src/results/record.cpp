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

bool same(std::span<const double> a, std::span<const double> b) {
  return std::ranges::equal(a, b, same_bits);
}

bool same(const Rows& a, const Rows& b) {
  return std::ranges::equal(a, b, [](const auto& x, const auto& y) { return same(x, y); });
}

}  // namespace

PointLayout::PointLayout(const Sweep& sweep) {
  const Loading& loading = sweep.base.loading;
  const bool searched = !loading.z_0 && !loading.trace;
  if (searched) groups.emplace_back("load_error");
  for (const ResultVariable& variable : result_variables(sweep)) add(variable, searched);
  variables.push_back({{"passages", "number of passages computed for the point", "N", "", Number::integer},
                       [](const PointResult& p) { return double(p.passages); },
                       0});
  const auto add_code = [&](const std::string& name, const std::string& long_name, Words meanings,
                            std::function<double(const PointResult&)> value, auto missing) {
    variables.push_back(
        {{name, long_name, "", "", Number::code, texts(meanings)}, std::move(value), double(missing)});
  };
  add_code(
      "status", "outcome of the point", words<PointStatus>(),
      [](const PointResult& p) { return double(p.status); }, PointStatus::absent);
  add_code(
      "start", "whether bristles bend or are crushed as the slab comes down", words<Start>(),
      [](const PointResult& p) { return double(p.start); }, Start::undetermined);
  add_code(
      "phase", "whether tips stay on the slab or bounce", words<BrushPhase>(),
      [](const PointResult& p) { return double(phase_of(p)); }, BrushPhase::unknown);
  if (sweep.base.setup.orientation.distribution != Distribution::von_mises) {  // as lift_off_load
    add_code(
        "lift_off_domain", "whether the formula of lift_off_load was tested here, or what is outside",
        words<LiftOffDomain>(), [](const PointResult& p) { return double(lift_off_domain(p.parameters)); },
        LiftOffDomain::tested);
    variables.back().equation = "docs/lift-off.md";
  }
  for (const ValidityRow& row : kValidity)
    add_code(
        row.name, fmt::format("beyond a limit of the model: {}", row.meaning), words<Exceeds>(),
        [&row](const PointResult& p) { return double(exceeds(row, p)); }, Exceeds::unknown);
  if (loading.trace)
    add_code("branch", "paths of the slab on which the node lies", words<Branch>(), {}, Branch::absent);
  if (sweep.record.bristles) tables.emplace_back("bristles");
  if (!sweep.record.trajectories.empty()) tables.emplace_back("trajectories");
  if (sweep.record.slab_force) tables.emplace_back("slab_force");
  if (loading.trace) nodes = std::size_t(loading.trace->nodes);
  std::string names = fmt::format("{}: ", nodes.value_or(1));
  for (const Variable& variable : variables) {
    numbers_.emplace(variable.name, numbers_.size());
    names += variable.name + ",";
  }
  for (const std::string& table : tables)
    for (const Column& column : table_columns(table)) names += fmt::format("{}/{},", table, column.name);
  digest_ = sha256_of(names).substr(0, 16);
}

// Adds the variable, its error and, if the gap was searched for, the part of the error due to the load.
void PointLayout::add(const ResultVariable& variable, bool searched) {
  const auto add_part = [&](Column column, double Quantity::*part) {
    variables.push_back(
        {std::move(column), [of = variable.of, part](const PointResult& p) { return of(p).*part; }});
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
}

Layout layout_of(const Sweep& sweep) { return std::make_shared<const PointLayout>(sweep); }

std::span<const double> PointRecord::at(const std::string& variable) const {
  const std::size_t count = nodes();
  return std::span(values).subspan(layout->number(variable) * count, count);
}

std::string why_missing(const PointRecord& record, const ResultVariable& variable) {
  if (variable.name.find("lift_off") != std::string::npos && record.layout->has("lift_off_domain"))
    if (const auto domain = LiftOffDomain(std::lround(record.at("lift_off_domain").front()));
        domain != LiftOffDomain::tested)
      return outside_of(domain);
  if (PointStatus(std::lround(record.at("status").front())) == PointStatus::undefined)
    return "it is a ratio to a load or friction of zero";
  return variable.why_missing;
}

PointRecord record_of(const Layout& layout, const PointResult& result, const Recorded& recorded) {
  PointRecord record{layout};
  for (const auto& variable : layout->variables) record.values.push_back(variable.value(result));
  for (const std::string& table : layout->tables) record.tables.push_back(table_rows(table, recorded));
  return with_unified_nan(std::move(record));
}

PointRecord record_of(const Layout& layout, const std::vector<CurveNode>& curve) {
  PointRecord record{layout};
  for (const auto& variable : layout->variables)
    for (const CurveNode& node : curve)
      record.values.push_back(variable.value ? variable.value(node.result) : double(node.branch));
  return with_unified_nan(std::move(record));
}

PointRecord failed_record(const Layout& layout, const std::string& error) {
  const PointResult result = without_values(PointStatus::failed);
  PointRecord record =
      layout->nodes ? record_of(layout, {{result, Branch::unstable}}) : record_of(layout, result, {});
  record.failure = error;
  return record;
}

PointRecord read_record(const ResultReader& result, const Sweep& sweep, std::size_t index) {
  const Layout layout = layout_of(sweep);
  const std::size_t nodes = layout->nodes.value_or(1);
  std::vector<std::size_t> shape = sweep.shape();
  if (layout->nodes) shape.push_back(nodes);
  const auto read = [&](const std::string& name) {
    const Array& array = result.variable(name);
    if (array.shape != shape)
      throw RunError(fmt::format("{} has the shape ({}), but the sweep has ({})", name,
                                 fmt::join(array.shape, ", "), fmt::join(shape, ", ")));
    const auto first = array.values.begin() + long(index * nodes);
    return std::vector<double>(first, first + long(nodes));
  };
  std::size_t present = nodes;
  if (layout->nodes) {
    const auto branch = read("branch");
    present = std::size_t(std::ranges::find(branch, double(Branch::absent)) - branch.begin());
  }
  PointRecord record{layout};
  for (const auto& variable : layout->variables) {
    const std::vector<double> values = read(variable.name);
    record.values.insert(record.values.end(), values.begin(), values.begin() + long(present));
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
  const std::size_t nodes = record.nodes();
  if (record.values.size() != nodes * layout.variables.size() || record.tables.size() != layout.tables.size())
    return false;
  if (layout.nodes ? nodes > *layout.nodes : nodes != 1) return false;
  for (std::size_t i = 0; i < record.tables.size(); ++i) {
    const Rows& rows = record.tables[i];
    if (rows.size() != table_columns(layout.tables[i]).size()) return false;
    for (const auto& column : rows)
      if (column.size() != rows.front().size()) return false;
  }
  return std::ranges::all_of(record.at("status"), [](double s) {
    return s >= 0 && s < double(words<PointStatus>().size()) && s == std::floor(s);
  });
}

std::vector<std::string> differences(const PointRecord& a, const PointRecord& b) {
  const PointLayout& layout = *a.layout;
  std::vector<std::string> out;
  for (const auto& variable : layout.variables)
    if (!same(a.at(variable.name), b.at(variable.name))) out.push_back(variable.name);
  for (std::size_t i = 0; i < layout.tables.size(); ++i)
    if (!same(a.tables[i], b.tables[i])) out.push_back(layout.tables[i]);
  return out;
}

}  // namespace bristle::results
