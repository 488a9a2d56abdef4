#include "results/record.hpp"

#include "ensemble/phase.hpp"
#include "ensemble/validity.hpp"
#include "model/lift_off.hpp"
#include "results/reader.hpp"
#include "results/version.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

namespace bristle::results {
namespace {

// The sign of a computed NaN depends on processor and compiler.
void unify_nan(std::vector<double>& numbers) {
  for (double& x : numbers)
    if (std::isnan(x)) x = std::numeric_limits<double>::quiet_NaN();
}

PointRecord with_unified_nan(PointRecord record) {
  for (auto& [name, numbers] : record.values) unify_nan(numbers);
  for (auto& [name, rows] : record.tables)
    for (auto& column : rows) unify_nan(column);
  return record;
}

// The rows of one point. Requires that the table is sorted by points.
Rows read_rows(hid_t file, const std::string& table, std::size_t index) {
  const h5::Handle group = h5::open_group(file, table);
  const auto read = [&](const std::string& column, hsize_t from, hsize_t count) {
    std::vector<double> out(count);
    if (count > 0)
      h5::read_part(h5::open_dataset(group, column), H5T_NATIVE_DOUBLE, {from}, {count}, out.data());
    return out;
  };
  const std::vector<double> points = read("point", 0, h5::length_of(h5::open_dataset(group, "point")));
  const auto [from, to] = std::equal_range(points.begin(), points.end(), double(index));
  const auto first = hsize_t(from - points.begin()), count = hsize_t(to - from);
  Rows rows;
  for (const std::string& column : table_columns(table)) rows.push_back(read(column, first, count));
  return rows;
}

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(a, b, same_bits);
}

bool same(const Rows& a, const Rows& b) {
  return std::ranges::equal(a, b, [](const auto& x, const auto& y) { return same(x, y); });
}

template <class Map>
void add_differences(const Map& a, const Map& b, std::vector<std::string>& out) {
  for (const auto& [name, values] : a)
    if (const auto other = b.find(name); other == b.end() || !same(values, other->second))
      out.push_back(name);
  for (const auto& [name, values] : b)
    if (!a.contains(name)) out.push_back(name);
}

}  // namespace

PointLayout::PointLayout(const Sweep& sweep) {
  const Loading& loading = sweep.base.loading;
  const bool searched = !loading.z_0 && !loading.trace;
  if (searched) groups.emplace_back("load_error");
  for (const ResultVariable& variable : result_variables(sweep)) add(variable, searched);
  datasets.push_back({{"passages", "number of passages computed for the point", "N", "", H5T_NATIVE_LONG},
                      [](const PointResult& p) { return double(p.passages); },
                      0});
  datasets.push_back(
      {{"status", "outcome of the point", "", "", H5T_NATIVE_SCHAR, texts(words<PointStatus>())},
       [](const PointResult& p) { return double(p.status); },
       double(PointStatus::absent)});
  datasets.push_back({{"start", "whether bristles bend or are crushed as the slab comes down", "", "",
                       H5T_NATIVE_SCHAR, texts(words<Start>())},
                      [](const PointResult& p) { return double(p.start); },
                      double(Start::undetermined)});
  datasets.push_back({{"phase", "whether tips stay on the slab or bounce", "", "", H5T_NATIVE_SCHAR,
                       texts(words<BrushPhase>())},
                      [](const PointResult& p) { return double(phase_of(p)); },
                      double(BrushPhase::unknown)});
  if (sweep.base.setup.orientation.distribution != Distribution::von_mises)  // as lift_off_load
    datasets.push_back(
        {{"lift_off_domain", "whether the formula of lift_off_load was tested here, or what is outside", "",
          "docs/lift-off.md", H5T_NATIVE_SCHAR, texts(words<LiftOffDomain>())},
         [](const PointResult& p) { return double(lift_off_domain(p.parameters)); },
         0});
  for (const ValidityRow& row : kValidity)
    datasets.push_back({{row.name, fmt::format("beyond a limit of the model: {}", row.meaning), "", "",
                         H5T_NATIVE_SCHAR, texts(words<Exceeds>())},
                        [&row](const PointResult& p) { return double(exceeds(row, p)); },
                        double(Exceeds::unknown)});
  if (loading.trace)
    datasets.push_back({{"branch", "paths of the slab on which the node lies", "", "", H5T_NATIVE_SCHAR,
                         texts(words<Branch>())},
                        {},
                        double(Branch::absent)});
  if (sweep.record.bristles) tables.emplace_back("bristles");
  if (!sweep.record.trajectories.empty()) tables.emplace_back("trajectories");
  if (sweep.record.slab_force) tables.emplace_back("slab_force");
  if (loading.trace) nodes = std::size_t(loading.trace->nodes);
}

// Adds the variable, its error, and the part of the error due to the load, if the gap follows from a search.
void PointLayout::add(const ResultVariable& variable, bool searched) {
  const auto add_part = [&](Column column, double Derived::*part) {
    datasets.push_back(
        {std::move(column), [of = variable.of, part](const PointResult& p) { return of(p).*part; }});
  };
  Column column = variable;
  column.ancillary = variable.errors == Errors::none ? "status" : variable.name + "_err status";
  add_part(column, &Derived::value);
  column.ancillary = "";
  column.symbol = R"(\delta )" + variable.symbol;
  if (searched && variable.errors == Errors::with_load) {
    column.name = "load_error/" + variable.name;
    column.long_name = "part of " + variable.name + "_err due to the deviation of the load from its target";
    add_part(column, &Derived::load_error);
  }
  column.name = variable.name + "_err";
  column.long_name = "estimated numerical error of " + variable.name;
  if (variable.errors != Errors::none) add_part(column, &Derived::error);
}

PointRecord record_of(const PointLayout& layout, const PointResult& result, const Recorded& recorded) {
  PointRecord record;
  for (const auto& dataset : layout.datasets) record.values[dataset.name] = {dataset.value(result)};
  for (const std::string& table : layout.tables) record.tables[table] = table_rows(table, recorded);
  return with_unified_nan(std::move(record));
}

PointRecord record_of(const PointLayout& layout, const std::vector<CurveNode>& curve) {
  PointRecord record;
  for (const auto& dataset : layout.datasets) {
    std::vector<double> numbers;
    for (const CurveNode& node : curve)
      numbers.push_back(dataset.value ? dataset.value(node.result) : double(node.branch));
    record.values[dataset.name] = std::move(numbers);
  }
  return with_unified_nan(std::move(record));
}

PointRecord failed_record(const PointLayout& layout, const std::string& error) {
  const PointResult result = without_values(PointStatus::failed);
  PointRecord record =
      layout.nodes ? record_of(layout, {{result, Branch::unstable}}) : record_of(layout, result, {});
  record.failure = error;
  return record;
}

PointRecord read_record(hid_t file, const Sweep& sweep, std::size_t index) {
  const PointLayout layout(sweep);
  PointRecord record;
  h5::Shape at = h5::position(sweep.shape(), index), count(at.size(), 1);
  if (layout.nodes) {
    at.push_back(0);
    count.push_back(hsize_t(*layout.nodes));
  }
  const auto read = [&](const std::string& name) {
    std::vector<double> out(layout.nodes ? count.back() : 1);
    h5::read_part(h5::open_dataset(file, name), H5T_NATIVE_DOUBLE, at, count, out.data());
    return out;
  };
  if (layout.nodes) {
    const auto branch = read("branch");
    count.back() = hsize_t(std::find(branch.begin(), branch.end(), double(Branch::absent)) - branch.begin());
  }
  for (const auto& dataset : layout.datasets) record.values[dataset.name] = read(dataset.name);
  for (const std::string& table : layout.tables) record.tables[table] = read_rows(file, table, index);
  if (h5::exists(file, kFailures)) {
    const h5::Handle failures = h5::open_group(file, kFailures);
    if (const std::string name = failure_name(index); h5::has_attribute(failures, name))
      record.failure = h5::read_text_attribute(failures, name);
  }
  return with_unified_nan(std::move(record));
}

std::string failure_name(std::size_t index) { return fmt::format("point_{}", index); }

bool fits(const PointRecord& record, const PointLayout& layout) {
  const bool complete =
      record.values.size() == layout.datasets.size() && record.tables.size() == layout.tables.size() &&
      std::ranges::all_of(layout.datasets, [&](const auto& d) { return record.values.contains(d.name); }) &&
      std::ranges::all_of(layout.tables, [&](const auto& name) { return record.tables.contains(name); });
  if (!complete) return false;
  const std::size_t nodes = record.values.begin()->second.size();
  const bool nodes_valid = layout.nodes ? nodes <= *layout.nodes : nodes == 1;
  const bool equal_lengths = std::all_of(record.values.begin(), record.values.end(),
                                         [&](const auto& v) { return v.second.size() == nodes; });
  const bool tables_valid = std::all_of(record.tables.begin(), record.tables.end(), [](const auto& t) {
    return t.second.size() == table_columns(t.first).size() &&
           std::all_of(t.second.begin(), t.second.end(),
                       [&](const auto& column) { return column.size() == t.second.front().size(); });
  });
  const auto& status = record.values.at("status");
  const bool status_known = std::all_of(status.begin(), status.end(), [](double s) {
    return s >= 0 && s < double(words<PointStatus>().size()) && s == std::floor(s);
  });
  return nodes_valid && equal_lengths && tables_valid && status_known;
}

std::vector<std::string> differences(const PointRecord& a, const PointRecord& b) {
  std::vector<std::string> out;
  add_differences(a.values, b.values, out);
  add_differences(a.tables, b.tables, out);
  return out;
}

}  // namespace bristle::results
