#include "results/tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <functional>
#include <map>
#include <numeric>

namespace bristle::results {
namespace {

constexpr std::size_t kBlock = 16384;  // values

// A column of a table and how to read it from the recorded data: for each bristle, for each point of each
// trajectory, or for each interval of the force on the slab.
struct Field {
  using Values = std::function<std::vector<double>(const Recorded&)>;

  Field(Column c, double (*value)(const Passage&)) : column(std::move(c)) {
    values = [value](const Recorded& recorded) {
      std::vector<double> out;
      for (const Passage& bristle : recorded.bristles) out.push_back(value(bristle));
      return out;
    };
  }
  Field(Column c, double (*value)(const Passage&, const TrajectoryPoint&)) : column(std::move(c)) {
    values = [value](const Recorded& recorded) {
      std::vector<double> out;
      for (const Trajectory& trajectory : recorded.trajectories)
        for (const TrajectoryPoint& point : trajectory.points)
          out.push_back(value(trajectory.passage, point));
      return out;
    };
  }
  Field(Column c, double (*value)(const SlabForce&, std::size_t)) : column(std::move(c)) {
    values = [value](const Recorded& recorded) {
      std::vector<double> out;
      for (std::size_t i = 0; i < recorded.slab_force.R_n.size(); ++i)
        out.push_back(value(recorded.slab_force, i));
      return out;
    };
  }

  Column column;
  Values values;
};

Column flag(const char* name, const char* long_name, Words meanings) {
  return {name, long_name, "", "", H5T_NATIVE_SCHAR, texts(meanings)};
}

Column angle(const char* name, const char* long_name, const char* symbol, const char* equation) {
  return {name, long_name, symbol, equation, H5T_NATIVE_DOUBLE, {}, "rad"};
}

using B = const Passage&;
std::vector<Field> bristle_fields() {
  return {
      {flag("status", "how the passage ended", words<Outcome>()), [](B b) { return double(b.outcome); }},
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
}

Column phase_column() {
  Column column = flag("phase", "phase of the tip's motion", words<Phase>());
  column.constants = {{"off_slab_wall_ranges", kOffSlabRanges}, {"side_slip_rad", kSideSlip}};
  return column;
}

using T = const TrajectoryPoint&;
std::vector<Field> trajectory_fields() {
  return {
      {angle("theta_0", "undeformed azimuth", R"(\theta_0)", ""), [](B b, T) { return b.theta_0; }},
      {flag("status", "how the passage ended", words<Outcome>()), [](B b, T) { return double(b.outcome); }},
      {{"xi", "time since the leading edge reached the bristle", R"(\xi)", "Eq. (A1)"},
       [](B, T p) { return p.xi; }},
      {{"x", "tip position along the motion", R"(\tilde{x})", "Eq. (2)"}, [](B, T p) { return p.y[X]; }},
      {{"y", "tip position across the motion", R"(\tilde{y})", "Eq. (2)"}, [](B, T p) { return p.y[Y]; }},
      {{"z", "tip position, vertical", R"(\tilde{z})", "Eq. (2)"}, [](B, T p) { return p.y[Z]; }},
      {{"v_x", "tip velocity along the motion", R"(\tilde{v}_x)", "Eq. (18)"},
       [](B, T p) { return p.y[VX]; }},
      {{"v_y", "tip velocity across the motion", R"(\tilde{v}_y)", "Eq. (18)"},
       [](B, T p) { return p.y[VY]; }},
      {{"v_z", "vertical tip velocity", R"(\tilde{v}_z)", "Eq. (18)"}, [](B, T p) { return p.y[VZ]; }},
      {angle("theta", "azimuth", R"(\theta)", "Eq. (17)"), [](B, T p) { return p.y[THETA]; }},
      {angle("phi", "polar angle", R"(\varphi)", "Eq. (18)"), [](B, T p) { return p.y[PHI]; }},
      {{"F_n", "normal force", R"(\tilde{F}_n)", "Eq. (3)"}, [](B, T p) { return p.F_n; }},
      {{"F_fx", "friction force along the motion", R"(\tilde{F}_{f,x})", "Eq. (5)"},
       [](B, T p) { return p.F_fx; }},
      {{"F_fy", "friction force across the motion", R"(\tilde{F}_{f,y})", "Eq. (5)"},
       [](B, T p) { return p.F_fy; }},
      {{"V_R", "speed relative to the slab", R"(V_R/V_0)", "Eq. (6)"}, [](B, T p) { return p.V_R; }},
      {phase_column(), [](B, T p) { return double(p.phase); }},
  };
}

using S = const SlabForce&;
std::vector<Field> slab_force_fields() {
  return {
      {{"t", "time at the middle of the interval", R"(\tilde{t})", "Eq. (A1)"},
       [](S f, std::size_t i) { return (double(i) + 0.5) * f.interval; }},
      {{"R_n", "normal load per bristle", R"(\tilde{R}_n/N_{c,0})", "Eq. (A3)"},
       [](S f, std::size_t i) { return f.R_n[i]; }},
      {{"R_x", "friction force per bristle along the motion", R"(\tilde{R}_x/N_{c,0})", "Eq. (A3)"},
       [](S f, std::size_t i) { return f.R_x[i]; }},
      {{"R_y", "friction force per bristle across the motion", R"(\tilde{R}_y/N_{c,0})", "Eq. (A3)"},
       [](S f, std::size_t i) { return f.R_y[i]; }},
      {{"N_c_ratio", "bristles in contact over those of rigid bristles", R"(N_c/N_{c,0})", "Eq. (A3)"},
       [](S f, std::size_t i) { return f.N_c[i]; }},
  };
}

// A table: the name of its row numbers, and its columns after "point".
struct Layout {
  std::string row;
  std::vector<Field> fields;
};

std::vector<Column> columns_of(const Layout& layout) {
  std::vector<Column> columns;
  for (const Field& field : layout.fields) columns.push_back(field.column);
  return columns;
}

const Layout& layout_of(const std::string& table) {
  static const std::map<std::string, Layout> layouts = {{"bristles", {"bristle", bristle_fields()}},
                                                        {"trajectories", {"step", trajectory_fields()}},
                                                        {"slab_force", {"interval", slab_force_fields()}}};
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

TableWriter::TableWriter(hid_t file, const std::string& name)
    : TableWriter(file, name, layout_of(name).row, columns_of(layout_of(name))) {}

TableWriter::TableWriter(hid_t file, const std::string& name, const std::string& row,
                         std::vector<Column> columns) {
  const h5::Shape open{H5S_UNLIMITED};
  const h5::Handle group = h5::create_group(file, name);
  h5::Handle rows = create_column(group, {row, "row number", "", "", H5T_NATIVE_LONG}, open);
  h5::make_scale(rows, row);
  columns.insert(columns.begin(),
                 {"point", "index of the sweep point, the last axis fastest", "", "", H5T_NATIVE_LONG});
  const bool has_status = std::ranges::find(columns, "status", &Column::name) != columns.end();
  for (Column& column : columns) {
    if (has_status && column.flags.empty()) column.ancillary = "status";
    h5::Handle dataset = create_column(group, column, open);
    h5::attach_scale(dataset, rows, 0);
    columns_.emplace_back(std::move(dataset), open);
  }
  columns_.emplace(columns_.begin(), std::move(rows), open);
}

void TableWriter::append(const Rows& rows) {
  std::vector<double> numbers(rows.front().size());
  std::iota(numbers.begin(), numbers.end(), double(length_));
  columns_[0].append(numbers);
  for (std::size_t i = 0; i < rows.size(); ++i) columns_[i + 1].append(rows[i]);
  length_ += numbers.size();
}

void TableWriter::flush() {
  for (BlockWriter& column : columns_) column.flush();
}

std::vector<std::string> table_columns(const std::string& table) {
  std::vector<std::string> names;
  for (const Field& field : layout_of(table).fields) names.push_back(field.column.name);
  return names;
}

Rows table_rows(const std::string& table, const Recorded& recorded) {
  Rows rows;
  for (const Field& field : layout_of(table).fields) rows.push_back(field.values(recorded));
  return rows;
}

}  // namespace bristle::results
