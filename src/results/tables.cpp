#include "results/tables.hpp"

#include <functional>
#include <map>

namespace bristle::results {
namespace {

using namespace component;

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
  return {name, long_name, "", "", Number::code, texts(meanings)};
}

Column angle(const char* name, const char* long_name, const char* symbol, const char* equation) {
  return {name, long_name, symbol, equation, Number::real, {}, "rad"};
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
      {{"N_c_ratio", "bristles in contact over rigid bristles in contact", R"(N_c/N_{c,0})", "Eq. (A3)"},
       [](S f, std::size_t i) { return f.N_c[i]; }},
  };
}

// A table: the name of its row numbers, and its columns after "point".
struct Layout {
  std::string row;
  std::vector<Field> fields;
};

const Layout& layout_of(const std::string& table) {
  static const std::map<std::string, Layout> layouts = {{"bristles", {"bristle", bristle_fields()}},
                                                        {"trajectories", {"step", trajectory_fields()}},
                                                        {"slab_force", {"interval", slab_force_fields()}}};
  return layouts.at(table);
}

}  // namespace

std::string row_name(const std::string& table) { return layout_of(table).row; }

std::vector<Column> table_columns(const std::string& table) {
  std::vector<Column> columns;
  for (const Field& field : layout_of(table).fields) columns.push_back(field.column);
  return columns;
}

Rows table_rows(const std::string& table, const Recorded& recorded) {
  Rows rows;
  for (const Field& field : layout_of(table).fields) rows.push_back(field.values(recorded));
  return rows;
}

}  // namespace bristle::results
