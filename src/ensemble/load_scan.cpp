#include "ensemble/load_path.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace bristle {
namespace {

// A hump is searched if it may reach the target to within this share of the target, in at most kHumpSteps
// steps.
constexpr double kHumpBelow = 0.05;
constexpr int kHumpSteps = 4;

std::vector<double> scan_gaps(const LoadSearch& search) {
  const double length = search.first_contact - search.ground;
  const int count = std::max(2, int(std::ceil(length / search.step)));
  std::vector<double> gaps;
  for (int i = 0; i <= count; ++i) gaps.push_back(search.first_contact - length * i / count);
  if (search.path == LoadPath::unloading) std::reverse(gaps.begin(), gaps.end());
  return gaps;
}

// The top of the parabola through the loads at equidistant gaps, of which b has the largest load, and its
// error.
double parabola_top(const GapLoad& a, const GapLoad& b, const GapLoad& c) {
  const double rise = std::max(0.0, b.excess - a.excess), fall = std::max(0.0, b.excess - c.excess);
  return b.excess + (rise - fall) * (rise - fall) / (8 * (rise + fall) + 1e-300) + b.load.error;
}

// The largest load found between two gaps on both sides of top, or the first that is above the target
// beyond doubt. The distance between the gaps is halved as long as the parabola through the loads may reach
// the target.
GapLoad top_of_hump(LoadsOnPath& loads, GapLoad a, GapLoad top, GapLoad c) {
  const auto found = [&] { return top.excess > loads.allowed() + kDistinct * top.load.error; };
  const auto between = [&](const GapLoad& one, const GapLoad& other) {
    const double z_0 = one.z_0 + (other.z_0 - one.z_0) / 2;
    const GapLoad probe = loads.at(z_0, Accuracy::rough);
    return probe.excess < 0 ? probe : loads.at(z_0, Accuracy::precise);
  };
  for (int i = 0; i < kHumpSteps && !found(); ++i) {
    if (parabola_top(a, top, c) < -kHumpBelow * loads.search.target) return top;
    const GapLoad left = between(a, top), right = between(top, c);
    if (left.excess > std::max(top.excess, right.excess)) c = std::exchange(top, left);
    else if (right.excess > top.excess) a = std::exchange(top, right);
    else a = left, c = right;
  }
  if (!found() && loads.near_target(top)) loads.reaches_by_noise = true;
  return top;
}

// If b is the top of a hump, searches between a and c for a gap with excess >= 0.
std::optional<GapLoad> find_in_hump(LoadsOnPath& loads, const GapLoad& a, const GapLoad& b,
                                    const GapLoad& c) {
  const double noise = a.load.error + b.load.error + c.load.error;
  const bool hump = b.excess < 0 && c.excess < 0 && b.excess >= std::max(a.excess, c.excess) - noise;
  if (!hump) return {};
  const GapLoad top = top_of_hump(loads, a, b, c);
  if (top.excess < 0) return {};
  return top;
}

// The load at this gap of the scan is above the target. If it equals the target within its error, and is
// below it at the next gap, looks for the top of the hump between the neighbouring gaps.
void examine_top(LoadsOnPath& loads, const GapLoad& before, const GapLoad& at) {
  if (!loads.near_target(at)) return;
  const GapLoad next = loads.one_step_beyond(at.z_0, Accuracy::rough);
  if (next.excess < 0) top_of_hump(loads, before, at, next);
}

// The wall is soft: a load below R_n at first contact occurs a few wall ranges lambda_z above it.
GapLoad above_contact(LoadsOnPath& loads) {
  const LoadSearch& search = loads.search;
  GapLoad probe = loads.at(search.first_contact, Accuracy::precise);
  double height = search.wall_range;  // above first contact
  while (probe.excess >= 0 && height < 100 * search.wall_range) {
    probe = loads.at(search.first_contact + height, Accuracy::precise);
    height *= 2;
  }
  return probe;
}

std::optional<LoadBracket> if_encloses(const LoadBracket& bracket) {
  if (bracket.encloses()) return bracket;
  return {};
}

// Brackets the crossing by the last scanned gap with negative excess, according to precise loads, and the gap
// after it.
std::optional<LoadBracket> bracket_before(LoadsOnPath& loads, GapLoad far,
                                          const std::vector<GapLoad>& scanned) {
  for (auto point = scanned.rbegin(); point != scanned.rend(); ++point) {
    const GapLoad near = loads.at(point->z_0, Accuracy::precise);
    if (near.excess < 0) return LoadBracket{near, far};
    far = near;
  }
  if (loads.search.path == LoadPath::unloading)
    return {};  // the load is below the target at the ground already
  return if_encloses({above_contact(loads), far});
}

}  // namespace

// A crossing found with rough loads is confirmed with precise loads.
std::optional<LoadBracket> scan_for_crossing(LoadsOnPath& loads) {
  std::vector<GapLoad> scanned;
  for (double z_0 : scan_gaps(loads.search)) {
    scanned.push_back(loads.at(z_0, Accuracy::rough));
    const std::size_t n = scanned.size();
    if (n >= 3)
      if (const auto far = find_in_hump(loads, scanned[n - 3], scanned[n - 2], scanned[n - 1])) {
        scanned.resize(n - 2);
        return bracket_before(loads, *far, scanned);
      }
    if (scanned.back().excess < 0) continue;
    const GapLoad far = loads.at(z_0, Accuracy::precise);
    if (far.excess < 0) {
      scanned.back() = far;
      continue;
    }
    scanned.pop_back();
    if (!scanned.empty()) examine_top(loads, scanned.back(), far);
    return bracket_before(loads, far, scanned);
  }
  return {};
}

}  // namespace bristle
