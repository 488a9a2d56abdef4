#include "run/jumps.hpp"

#include "results/writer.hpp"
#include "util/grid.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace bristle::run {
namespace {

constexpr double kLeastJump = 0.1;  // change of z_0, in units of r0
constexpr double kWidth = 0.02;     // relative width of the interval that contains a located jump

constexpr int kMostHalvings = 20;

// Part of the axis across which the gap jumps.
struct Interval {
  std::size_t point;  // point of the sweep, at or below low on the axis
  double low, high;
  Gap at_low, at_high;
  int halvings = 0;  // bounded: near zero no interval is narrow relative to its values

  bool wide() const {
    return halvings < kMostHalvings && high - low > kWidth * std::max(std::abs(low), std::abs(high));
  }
  double middle() const { return low > 0 ? std::sqrt(low * high) : (low + high) / 2; }
};

// Returns the intervals between neighbouring points of the sweep across which the gap jumps.
std::vector<Interval> intervals_of(const Sweep& sweep, std::size_t axis, const std::vector<Gap>& gaps) {
  const auto shape = sweep.shape();
  const std::vector<double>& values = sweep.axes[axis].values;
  std::vector<Interval> out;
  for (std::size_t point = 0; point < gaps.size(); ++point) {
    auto at = unravel(point, shape);
    const std::size_t i = at[axis]++;
    if (i + 1 == values.size()) continue;
    const Interval interval{point, values[i], values[i + 1], gaps[point], gaps[ravel(at, shape)]};
    if (jumps(interval.at_low, interval.at_high)) out.push_back(interval);
  }
  return out;
}

// Returns the first point of the line along the axis on which a point lies.
std::size_t line_of(const Sweep& sweep, std::size_t axis, std::size_t point) {
  auto at = unravel(point, sweep.shape());
  at[axis] = 0;
  return ravel(at, sweep.shape());
}

// All computed points of a line of the sweep along the axis: value of the axis -> whether the point is
// undecided.
using Line = std::map<double, bool>;

// Halves the intervals. Adds the points in the middle to their lines. Returns the halves across which the gap
// jumps.
std::vector<Interval> halve(const Sweep& sweep, std::size_t axis, const std::vector<Interval>& intervals,
                            const SolvePoints& solve, std::map<std::size_t, Line>& lines) {
  std::set<double> middles;
  for (const Interval& interval : intervals) middles.insert(interval.middle());
  Sweep between = sweep.with({sweep.axes[axis].name, {middles.begin(), middles.end()}});
  between.record = {};
  std::vector<std::size_t> points;
  for (const Interval& interval : intervals) {
    auto at = unravel(interval.point, sweep.shape());
    at[axis] = std::size_t(std::distance(middles.begin(), middles.find(interval.middle())));
    points.push_back(ravel(at, between.shape()));
  }
  const std::vector<Gap> found = solve(between, points);
  std::vector<Interval> out;
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    const Interval& whole = intervals[i];
    lines[line_of(sweep, axis, whole.point)][whole.middle()] = found[i].undecided;
    for (const Interval& half :
         {Interval{whole.point, whole.low, whole.middle(), whole.at_low, found[i], whole.halvings + 1},
          Interval{whole.point, whole.middle(), whole.high, found[i], whole.at_high, whole.halvings + 1}})
      if (jumps(half.at_low, half.at_high)) out.push_back(half);
  }
  return out;
}

// Returns the band of a jump: on each side of the interval it extends to the last of the adjacent points with
// undecided gaps.
std::pair<double, double> band_of(const Line& line, const Interval& jump) {
  double from = jump.low, to = jump.high;
  for (auto at = line.find(jump.low); at->second; --at) {
    from = at->first;
    if (at == line.begin()) break;
  }
  for (auto at = line.find(jump.high); at != line.end() && at->second; ++at) to = at->first;
  return {from, to};
}

}  // namespace

Gap gap_of(const results::PointRecord& record) {
  const double z_0 = record.at("z_0");
  const auto status = PointStatus(int(record.at("status")));
  return {status == PointStatus::unreachable || std::isfinite(z_0), z_0, status == PointStatus::ambiguous};
}

bool jumps(const Gap& a, const Gap& b) {
  if (!a.known || !b.known || (std::isnan(a.z_0) && std::isnan(b.z_0))) return false;
  return !(std::abs(a.z_0 - b.z_0) <= kLeastJump);  // true also if one gap is NaN
}

results::Rows locate_jumps(const Sweep& sweep, const std::string& along, const std::vector<Gap>& gaps,
                           const SolvePoints& solve) {
  const std::size_t axis = sweep.axis_number(along);
  std::map<std::size_t, Line> lines;
  for (std::size_t point = 0; point < gaps.size(); ++point)
    lines[line_of(sweep, axis, point)][sweep.axes[axis].values[unravel(point, sweep.shape())[axis]]] =
        gaps[point].undecided;
  std::vector<Interval> open = intervals_of(sweep, axis, gaps), located;
  while (!open.empty()) {
    const auto narrow = std::partition(open.begin(), open.end(), [](const Interval& i) { return i.wide(); });
    located.insert(located.end(), narrow, open.end());
    open.erase(narrow, open.end());
    if (!open.empty()) open = halve(sweep, axis, open, solve, lines);
  }
  std::ranges::sort(located, {}, [](const Interval& i) { return std::pair(i.point, i.low); });
  results::Rows rows(results::jump_columns(sweep, along).size() + 1);
  for (const Interval& i : located) {
    const auto [from, to] = band_of(lines.at(line_of(sweep, axis, i.point)), i);
    std::vector<double> row = {double(i.point), i.low, i.high, i.at_low.z_0, i.at_high.z_0, from, to};
    const auto at = unravel(i.point, sweep.shape());
    for (std::size_t other = 0; other < at.size(); ++other)
      if (other != axis) row.push_back(sweep.axes[other].values[at[other]]);
    for (std::size_t column = 0; column < rows.size(); ++column) rows[column].push_back(row[column]);
  }
  return rows;
}

}  // namespace bristle::run
