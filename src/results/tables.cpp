#include "results/tables.hpp"

#include "results/variables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <map>
#include <numeric>

namespace bristle::results {
namespace {

constexpr std::size_t kBlock = 16384;  // values

// A column and its value for a record.
template <class Record>
struct Field {
  Column column;
  double (*value)(const Record&);
};

Column flag(const char* name, const char* long_name, const std::vector<std::string>& meanings) {
  return {name, long_name, "", "", H5T_NATIVE_SCHAR, meanings};
}

Column angle(const char* name, const char* long_name, const char* symbol, const char* equation) {
  return {name, long_name, symbol, equation, H5T_NATIVE_DOUBLE, {}, "rad"};
}

template <class Record>
std::vector<Column> columns(const std::vector<Field<Record>>& fields, std::vector<Column> first = {}) {
  for (const auto& field : fields) first.push_back(field.column);
  return first;
}

template <class Record>
void add(Rows& rows, const std::vector<Field<Record>>& fields, const std::vector<Record>& records) {
  for (const auto& field : fields) {
    rows.emplace_back();
    for (const Record& record : records) rows.back().push_back(field.value(record));
  }
}

using B = const Passage&;
const std::vector<Field<Passage>>& bristle_fields() {
  static const std::vector<Field<Passage>> fields = {
      {flag("status", "how the passage ended", kOutcomeNames), [](B b) { return double(b.outcome); }},
      {angle("theta_0", "undeformed azimuth", R"(\theta_0)", ""), [](B b) { return b.theta_0; }},
      {{"contact_time", "contact time", R"(\Delta\xi)", "Eq. (A2)"}, [](B b) { return b.contact_time; }},
      {{"normal_impulse", "integral of F_n", R"(\int F_n)", "Eq. (3)"}, [](B b) { return b.end[NORMAL]; }},
      {{"friction_impulse_x", "integral of the friction force along the motion", R"(\int F_{f,x})",
        "Eq. (5)"},
       [](B b) { return b.end[FRICTION_X]; }},
      {{"friction_impulse_y", "integral of the friction force across the motion", R"(\int F_{f,y})",
        "Eq. (5)"},
       [](B b) { return b.end[FRICTION_Y]; }},
      {{"gamma_1", "ratio in Eq. (24)", R"(\tilde{\gamma}_{1,i})", "Eq. (24)"},
       [](B b) { return b.gamma_1; }},
      {{"gamma_2", "ratio in Eq. (25)", R"(\tilde{\gamma}_{2,i})", "Eq. (25)"},
       [](B b) { return b.gamma_2; }},
      {{"gamma_3", "ratio in Eq. (26)", R"(\tilde{\gamma}_{3,i})", "Eq. (26)"},
       [](B b) { return b.gamma_3; }},
      {{"energy_residual", "error of the energy budget over the dissipated or initial energy",
        R"(\epsilon_E)", ""},
       [](B b) { return b.energy_residual; }},
      {{"steps", "integration steps", "", ""}, [](B b) { return double(b.steps); }},
      {{"reflections", "arrivals at the pole, s = s_min", "", ""}, [](B b) { return double(b.reflections); }},
  };
  return fields;
}

Column phase_column() {
  Column column = flag("phase", "phase of the tip's motion", kPhaseNames);
  column.constants = {{"off_slab_wall_ranges", kOffSlabRanges}, {"side_slip_rad", kSideSlip}};
  return column;
}

using T = const TrajectoryPoint&;
const std::vector<Field<TrajectoryPoint>>& trajectory_fields() {
  static const std::vector<Field<TrajectoryPoint>> fields = {
      {{"xi", "time since the leading edge reached the bristle", R"(\xi)", "Eq. (A1)"},
       [](T p) { return p.xi; }},
      {{"x", "tip position along the motion", R"(\tilde{x})", "Eq. (2)"}, [](T p) { return p.y[X]; }},
      {{"y", "tip position across the motion", R"(\tilde{y})", "Eq. (2)"}, [](T p) { return p.y[Y]; }},
      {{"z", "tip position, vertical", R"(\tilde{z})", "Eq. (2)"}, [](T p) { return p.y[Z]; }},
      {{"v_x", "tip velocity along the motion", R"(\tilde{v}_x)", "Eq. (18)"}, [](T p) { return p.y[VX]; }},
      {{"v_y", "tip velocity across the motion", R"(\tilde{v}_y)", "Eq. (18)"}, [](T p) { return p.y[VY]; }},
      {{"v_z", "vertical tip velocity", R"(\tilde{v}_z)", "Eq. (18)"}, [](T p) { return p.y[VZ]; }},
      {angle("theta", "azimuth", R"(\theta)", "Eq. (17)"), [](T p) { return p.y[THETA]; }},
      {angle("phi", "polar angle", R"(\varphi)", "Eq. (18)"), [](T p) { return p.y[PHI]; }},
      {{"F_n", "normal force", R"(\tilde{F}_n)", "Eq. (3)"}, [](T p) { return p.F_n; }},
      {{"F_fx", "friction force along the motion", R"(\tilde{F}_{f,x})", "Eq. (5)"},
       [](T p) { return p.F_fx; }},
      {{"F_fy", "friction force across the motion", R"(\tilde{F}_{f,y})", "Eq. (5)"},
       [](T p) { return p.F_fy; }},
      {{"V_R", "speed relative to the slab", R"(V_R/V_0)", "Eq. (6)"}, [](T p) { return p.V_R; }},
      {phase_column(), [](T p) { return double(p.phase); }},
  };
  return fields;
}

// A recorded table: the name of its row numbers, and its columns after "point".
struct Layout {
  std::string row;
  std::vector<Column> columns;
};

const Layout& layout_of(const std::string& table) {
  static const std::map<std::string, Layout> layouts = {
      {"bristles", {"bristle", columns(bristle_fields())}},
      {"trajectories",
       {"step", columns(trajectory_fields(), {angle("theta_0", "undeformed azimuth", R"(\theta_0)", ""),
                                              flag("status", "how the passage ended", kOutcomeNames)})}},
      {"slab_force",
       {"interval",
        {{"t", "time at the middle of the interval", R"(\tilde{t})", "Eq. (A1)"},
         {"R_n", "normal load per bristle", R"(\tilde{R}_n/N_{c,0})", "Eq. (A3)"},
         {"R_x", "friction force per bristle along the motion", R"(\tilde{R}_x/N_{c,0})", "Eq. (A3)"},
         {"R_y", "friction force per bristle across the motion", R"(\tilde{R}_y/N_{c,0})", "Eq. (A3)"},
         {"N_c_ratio", "bristles in contact over those of rigid bristles", R"(N_c/N_{c,0})", "Eq. (A3)"}}}},
      {"jumps",
       {"jump",
        {{"before", "value of the axis before the jump", "", ""},
         {"after", "value of the axis after the jump", "", ""},
         {"z_0_before", "gap before the jump; NaN: no gap carries the load", R"(\tilde{z}_0)", ""},
         {"z_0_after", "gap after the jump; NaN: no gap carries the load", R"(\tilde{z}_0)", ""}}}},
  };
  return layouts.at(table);
}

}  // namespace

void describe(hid_t dataset, const Column& column) {
  h5::write_attribute(dataset, "long_name", column.long_name);
  h5::write_attribute(dataset, "units", column.units);
  h5::write_attribute(dataset, "symbol", column.symbol);
  h5::write_attribute(dataset, "equation", column.equation);
  if (!column.ancillary.empty()) h5::write_attribute(dataset, "ancillary_variables", column.ancillary);
  for (const auto& [name, value] : column.constants) h5::write_attribute(dataset, name, value);
  if (column.flags.empty()) return;
  std::vector<signed char> values(column.flags.size());
  std::iota(values.begin(), values.end(), static_cast<signed char>(0));
  h5::write_attribute(dataset, "flag_values", values);
  h5::write_attribute(dataset, "flag_meanings", fmt::format("{}", fmt::join(column.flags, " ")));
}

h5::Handle create_column(hid_t parent, const Column& column, const h5::Shape& shape) {
  h5::Handle dataset = h5::create_dataset(parent, column.name, column.type, shape);
  describe(dataset, column);
  return dataset;
}

BlockWriter::BlockWriter(h5::Handle dataset, const h5::Shape& shape)
    : dataset_(std::move(dataset)), shape_(shape.begin(), shape.end()) {}

void BlockWriter::append(const std::vector<double>& values) {
  if (values_.size() + values.size() > kBlock) flush();
  values_.insert(values_.end(), values.begin(), values.end());
}

void BlockWriter::flush() {
  for (std::size_t done = 0; done < values_.size();) {
    const std::size_t left = values_.size() - done;
    const h5::Shape start = h5::position(shape_, first_ + done);
    // The largest part of the dataset that begins here and whose values follow one another.
    h5::Shape count(start.size(), 1);
    std::size_t size = 1;
    for (std::size_t d = shape_.size(); d-- > 0;) {
      count[d] = std::min(shape_[d] - std::size_t(start[d]), left / size);
      size *= std::size_t(count[d]);
      if (count[d] < shape_[d]) break;
    }
    h5::write_part(dataset_, H5T_NATIVE_DOUBLE, start, count, values_.data() + done);
    done += size;
  }
  first_ += values_.size();
  values_.clear();
}

Table::Table(hid_t file, const std::string& name) : name_(name), group_(h5::create_group(file, name)) {
  const h5::Shape open{H5S_UNLIMITED};
  const Layout& layout = layout_of(name);
  h5::Handle rows = create_column(group_, {layout.row, "row number", "", "", H5T_NATIVE_LONG}, open);
  h5::make_scale(rows, layout.row);
  std::vector<Column> columns{
      {"point", "index of the sweep point, the last axis fastest", "", "", H5T_NATIVE_LONG}};
  columns.insert(columns.end(), layout.columns.begin(), layout.columns.end());
  const bool has_status = std::ranges::find(columns, "status", &Column::name) != columns.end();
  for (Column& column : columns) {
    if (has_status && column.flags.empty()) column.ancillary = "status";
    h5::Handle dataset = create_column(group_, column, open);
    h5::attach_scale(dataset, rows, 0);
    columns_.emplace_back(std::move(dataset), open);
  }
  columns_.emplace(columns_.begin(), std::move(rows), open);
}

void Table::append(const Rows& rows) {
  std::vector<double> numbers(rows.front().size());
  std::iota(numbers.begin(), numbers.end(), double(length_));
  columns_[0].append(numbers);
  for (std::size_t i = 0; i < rows.size(); ++i) columns_[i + 1].append(rows[i]);
  length_ += numbers.size();
}

void Table::flush() {
  for (BlockWriter& column : columns_) column.flush();
}

void Table::close() {
  for (BlockWriter& column : columns_) column.close("closing a column of /" + name_);
  group_.close("closing /" + name_);
}

std::vector<std::string> table_columns(const std::string& table) {
  std::vector<std::string> names;
  for (const Column& column : layout_of(table).columns) names.push_back(column.name);
  return names;
}

Rows bristle_rows(const std::vector<Passage>& bristles) {
  Rows rows;
  add(rows, bristle_fields(), bristles);
  return rows;
}

Rows trajectory_rows(const Trajectory& trajectory) {
  const std::size_t n = trajectory.points.size();
  Rows rows{std::vector<double>(n, trajectory.passage.theta_0),
            std::vector<double>(n, double(trajectory.passage.outcome))};
  add(rows, trajectory_fields(), trajectory.points);
  return rows;
}

Rows slab_force_rows(const SlabForce& force) {
  std::vector<double> t;
  for (std::size_t i = 0; i < force.R_n.size(); ++i) t.push_back((double(i) + 0.5) * force.interval);
  return {t, force.R_n, force.R_x, force.R_y, force.N_c};
}

}  // namespace bristle::results
