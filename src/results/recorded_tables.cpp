#include "results/recorded_tables.hpp"

#include "results/variables.hpp"

#include <map>

namespace bristle::results {
namespace {

// A column and the function that gives its value for a record.
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

Table create_table(hid_t file, const std::string& table) {
  const Layout& layout = layout_of(table);
  std::vector<Column> all{
      {"point", "index of the sweep point, the last axis fastest", "", "", H5T_NATIVE_LONG}};
  all.insert(all.end(), layout.columns.begin(), layout.columns.end());
  return {file, table, layout.row, all};
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
