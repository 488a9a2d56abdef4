#include "passages.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace bristle::page {
namespace {

constexpr double kInterval = 0.03;  // time between rows, in r0/V0

double rounded(double value, double unit) { return std::round(value / unit) * unit; }

// Returns the rows of a trajectory that a drawing needs: one in each interval, where the phase changes, and
// the largest normal force of each interval.
std::vector<const TrajectoryPoint*> rows_of(const Trajectory& trajectory) {
  std::vector<const TrajectoryPoint*> rows;
  const TrajectoryPoint* largest = nullptr;
  for (const TrajectoryPoint& point : trajectory.points) {
    const bool next = rows.empty() || point.xi >= rows.back()->xi + kInterval ||
                      point.phase != rows.back()->phase || &point == &trajectory.points.back();
    if (!next) {
      if (!largest || point.F_n > largest->F_n) largest = &point;
      continue;
    }
    if (largest && largest->F_n > point.F_n && largest->F_n > rows.back()->F_n) rows.push_back(largest);
    rows.push_back(&point);
    largest = nullptr;
  }
  return rows;
}

}  // namespace

Json passages_of(const Recorded& recorded, const PointResult& point) {
  using namespace component;
  Json out = Json::array();
  for (const Trajectory& trajectory : recorded.trajectories) {
    Json passage = {{"theta_0", trajectory.passage.theta_0},
                    {"model", word(point.parameters.bending)},
                    {"phi_0", point.parameters.phi_0},
                    {"L_x", point.parameters.L_x},
                    {"z_0", point.z_0}};
    if (std::isfinite(point.si.force))
      passage["units"] = {{"force", {point.si.force, "N"}},
                          {"time", {point.si.length / point.si.velocity, "s"}}};
    for (const TrajectoryPoint* row : rows_of(trajectory)) {
      const auto add = [&](const char* name, double value, double unit) {
        passage[name].push_back(rounded(value, unit));
      };
      add("xi", row->xi, 1e-4);
      add("x", row->y[X], 1e-3);
      add("y", row->y[Y], 1e-3);
      add("z", row->y[Z], 1e-3);
      add("F_n", row->F_n, 1e-3);
      add("F_fx", row->F_fx, 1e-3);
      add("F_fy", row->F_fy, 1e-3);
      passage["phase"].push_back(word(row->phase));
    }
    out.push_back(std::move(passage));
  }
  return out;
}

}  // namespace bristle::page
