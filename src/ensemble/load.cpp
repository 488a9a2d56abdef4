#include "ensemble/load.hpp"

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/roots.hpp>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace bristle {
namespace {

struct NotComputable {};

// A load is above or below the target if its distance exceeds this multiple of its error.
constexpr double kDistinct = 2;
// Distance before a crossing, in steps of the scan, at which the load is checked to be below the target.
constexpr double kNeighbour = 0.125;
constexpr int kMaxEarlier = 4;  // number of times that the search moves to an earlier crossing

// R_n at one gap. excess is R_n minus the target on the
// loading path, the target minus R_n on the unloading path.
struct GapLoad {
  double z_0;
  Load load;
  double excess;
};

class CrossingSearch {
 public:
  CrossingSearch(const LoadCurve& curve, const LoadSearch& search) : curve_(curve), search_(search) {}

  LoadPoint run() {
    LoadPoint out;
    try {
      if (!find_bracket(out)) return out;
      locate_crossing(out);
    } catch (const NotComputable&) {
      out.status = LoadStatus::failed;
    }
    return out;
  }

 private:
  GapLoad load_at(double z_0, Accuracy accuracy) {
    const Load load = curve_(z_0, accuracy);
    if (!std::isfinite(load.R_n)) throw NotComputable{};
    const double sign = search_.path == LoadPath::loading ? 1 : -1;
    computed_.push_back({z_0, load, sign * (load.R_n - search_.target)});
    return computed_.back();
  }

  std::vector<double> scan_gaps() const {
    const double length = search_.first_contact - search_.ground;
    const int count = std::max(2, int(std::ceil(length / search_.step)));
    std::vector<double> gaps;
    for (int i = 0; i <= count; ++i) gaps.push_back(search_.first_contact - length * i / count);
    if (search_.path == LoadPath::unloading) std::reverse(gaps.begin(), gaps.end());
    return gaps;
  }

  // Finds the first neighbouring gaps of the scan with excess < 0 before and >= 0 after the crossing. A
  // crossing found with rough loads is confirmed with precise loads.
  bool find_bracket(LoadPoint& out) {
    std::vector<GapLoad> scanned;
    for (double z_0 : scan_gaps()) {
      scanned.push_back(load_at(z_0, Accuracy::rough));
      const std::size_t n = scanned.size();
      if (n >= 3)
        if (const auto far = find_in_hump(scanned[n - 3], scanned[n - 2], scanned[n - 1])) {
          scanned.resize(n - 2);
          return bracket_before(out, *far, scanned);
        }
      if (scanned.back().excess < 0) continue;
      scanned.back() = load_at(z_0, Accuracy::precise);
      if (scanned.back().excess < 0) continue;
      const GapLoad far = scanned.back();
      scanned.pop_back();
      if (!scanned.empty()) examine_top(scanned.back().z_0, far);
      return bracket_before(out, far, scanned);
    }
    return false;
  }

  double allowed() const { return search_.rtol * search_.target; }

  // Whether the load at this gap equals the target within its tolerance or its error.
  bool near_target(const GapLoad& at) {
    if (std::abs(at.excess) > allowed() + 2 * kDistinct * at.load.error) return false;
    const GapLoad reported = load_at(at.z_0, Accuracy::reported);
    return std::abs(reported.excess) <= std::max(allowed(), kDistinct * reported.load.error);
  }

  // The gap that lies beyond z_0 on the path by this distance, or before it if the distance is negative.
  double beyond(double z_0, double distance) const {
    return z_0 + (search_.path == LoadPath::loading ? -distance : distance);
  }

  GapLoad next_of_scan(double z_0, Accuracy accuracy) {
    return load_at(std::clamp(beyond(z_0, search_.step), search_.ground, search_.first_contact), accuracy);
  }

  // The load at this gap of the scan is above the target. If it equals the target within its error, and is
  // below it at the next gap, looks for the top of the hump between the neighbouring gaps.
  void examine_top(double before, const GapLoad& at) {
    if (!near_target(at)) return;
    const GapLoad next = next_of_scan(at.z_0, Accuracy::rough);
    if (next.excess < 0) top_of_hump(before, at, next.z_0);
  }

  // Brackets the crossing by the last scanned gap with negative excess,
  // according to precise loads, and the gap after it.
  bool bracket_before(LoadPoint& out, GapLoad far, const std::vector<GapLoad>& scanned) {
    for (auto point = scanned.rbegin(); point != scanned.rend(); ++point) {
      const GapLoad near = load_at(point->z_0, Accuracy::precise);
      if (near.excess < 0) return set_bracket(out, near, far);
      far = near;
    }
    if (search_.path == LoadPath::unloading)
      return false;  // the load is below the target at the ground already
    return set_bracket(out, above_contact(), far);
  }

  // The wall is soft: a load below R_n at first contact occurs a few wall ranges lambda_z above it.
  GapLoad above_contact() {
    GapLoad probe = load_at(search_.first_contact, Accuracy::precise);
    double height = search_.wall_range;  // above first contact
    while (probe.excess >= 0 && height < 100 * search_.wall_range) {
      probe = load_at(search_.first_contact + height, Accuracy::precise);
      height *= 2;
    }
    return probe;
  }

  // If b is the top of a hump, searches between a and c for a gap with excess >= 0. Only humps whose parabola
  // reaches to within 5 % of the target are searched.
  std::optional<GapLoad> find_in_hump(const GapLoad& a, const GapLoad& b, const GapLoad& c) {
    const double noise = a.load.error + b.load.error + c.load.error;
    const bool hump = b.excess < 0 && c.excess < 0 && b.excess >= std::max(a.excess, c.excess) - noise;
    if (!hump) return {};
    const double rise = std::max(0.0, b.excess - a.excess), fall = std::max(0.0, b.excess - c.excess);
    const double peak = b.excess + (rise - fall) * (rise - fall) / (8 * (rise + fall) + 1e-300);
    if (peak + b.load.error < -0.05 * search_.target) return {};
    const GapLoad top = top_of_hump(a.z_0, b, c.z_0);
    if (top.excess < 0) return {};
    return top;
  }

  // The largest load found between two gaps on both sides of b, or the first that is above the target beyond
  // doubt.
  GapLoad top_of_hump(double before, const GapLoad& b, double after) {
    GapLoad top = b;
    const auto found = [&] { return top.excess > allowed() + kDistinct * top.load.error; };
    const auto negative_excess = [&](double z_0) {
      if (found()) return -top.excess;  // ends the search quickly
      GapLoad probe = load_at(z_0, Accuracy::rough);
      if (probe.excess >= 0) probe = load_at(z_0, Accuracy::precise);
      if (probe.excess > top.excess) top = probe;
      return -probe.excess;
    };
    std::uintmax_t iterations = 12;
    const auto [low, high] = std::minmax(before, after);
    boost::math::tools::brent_find_minima(negative_excess, low, high, 12, iterations);
    if (!found() && near_target(top)) reaches_by_noise_ = true;
    return top;
  }

  static bool set_bracket(LoadPoint& out, const GapLoad& near, const GapLoad& far) {
    out.z_0_near = near.z_0;
    out.z_0_far = far.z_0;
    return near.excess < 0;
  }

  struct Bracket {
    GapLoad near, far;
    std::optional<GapLoad> solution{};  // within rtol of the target
  };

  // Narrows the bracket to a gap at which the load is within rtol of the target, or to z_0_resolution.
  void narrow(Bracket& b, Accuracy accuracy) {
    if (std::abs(b.far.excess) <= allowed()) {
      b.solution = b.far;
      return;
    }
    const auto excess = [&](double z_0) {
      const GapLoad probe = load_at(z_0, accuracy);
      (probe.excess < 0 ? b.near : b.far) = probe;
      if (std::abs(probe.excess) > allowed()) return probe.excess;
      b.solution = probe;
      return 0.0;
    };
    const bool descending = b.near.z_0 > b.far.z_0;
    const GapLoad low = descending ? b.far : b.near, high = descending ? b.near : b.far;
    const auto close = [&](double l, double r) { return r - l <= search_.z_0_resolution; };
    std::uintmax_t iterations = 60;
    boost::math::tools::toms748_solve(excess, low.z_0, high.z_0, low.excess, high.excess, close, iterations);
  }

  Bracket bracket_of(double near, double far, Accuracy accuracy) {
    return {load_at(near, accuracy), load_at(far, accuracy)};
  }

  void locate_crossing(LoadPoint& out) {
    Bracket b = bracket_of(out.z_0_near, out.z_0_far, Accuracy::precise);
    narrow(b, Accuracy::precise);
    for (int i = 0; b.solution && i < kMaxEarlier; ++i) {
      const auto earlier =
          earlier_crossing(bracket_of(out.z_0_near, out.z_0_far, Accuracy::precise), *b.solution);
      if (!earlier) break;
      out.z_0_far = earlier->z_0;
      b = {load_at(out.z_0_near, Accuracy::precise), *earlier};
      narrow(b, Accuracy::precise);
    }
    if (b.solution && only_touches(b.solution->z_0, out.z_0_far)) reaches_by_noise_ = true;
    if (!b.solution) {
      // A jump, or the noise of the means: the reported loads decide.
      b = bracket_of(b.near.z_0, b.far.z_0, Accuracy::reported);
      if (b.near.excess >= 0 || b.far.excess < 0) b = located_again(out);
    }
    out.ambiguous = reaches_by_noise_;
    set_result(out, b.near, b.far, b.solution);
  }

  // A gap a little before the crossing whose load is above the target already: then the load between has a
  // maximum and a minimum.
  std::optional<GapLoad> earlier_crossing(const Bracket& scan, const GapLoad& crossing) {
    const double distance = kNeighbour * search_.step;
    if (std::abs(scan.near.z_0 - crossing.z_0) <= distance) return {};
    const double z_0 = beyond(crossing.z_0, -distance);
    GapLoad probe = load_at(z_0, Accuracy::rough);
    if (probe.excess < -kDistinct * probe.load.error) return {};
    probe = load_at(z_0, Accuracy::precise);
    if (probe.excess >= 0) return probe;
    // On an even slope the load there would be below the target beyond doubt.
    const double slope = (scan.far.excess - scan.near.excess) / std::abs(scan.far.z_0 - scan.near.z_0);
    if (slope * distance > allowed() + kDistinct * probe.load.error && near_target(probe))
      reaches_by_noise_ = true;
    return {};
  }

  // Whether no load between the crossing and the far end of its bracket exceeds the target by more than the
  // errors, and the load is below the target again beyond.
  bool only_touches(double crossing, double far) {
    const auto [low, high] = std::minmax(crossing, far);
    const bool exceeds =
        std::any_of(computed_.begin(), computed_.end(), [low = low, high = high](const GapLoad& one) {
          return low <= one.z_0 && one.z_0 <= high && one.excess > kDistinct * one.load.error;
        });
    return !exceeds && next_of_scan(far, Accuracy::rough).excess < 0;
  }

  // Locates the crossing by reported loads: the precise ones misled the search.
  Bracket located_again(const LoadPoint& out) {
    Bracket b = bracket_of(out.z_0_near, out.z_0_far, Accuracy::reported);
    const double end = search_.path == LoadPath::loading ? search_.ground : search_.first_contact;
    while (b.far.excess < 0 && b.far.z_0 != end) {
      b.near = b.far;
      b.far = next_of_scan(b.far.z_0, Accuracy::reported);
    }
    if (b.near.excess < 0 && b.far.excess >= 0) narrow(b, Accuracy::reported);
    else reaches_by_noise_ = true;
    return b;
  }

  void set_result(LoadPoint& out, const GapLoad& near, const GapLoad& far,
                  const std::optional<GapLoad>& solution) {
    const GapLoad& final = solution ? *solution : far;
    out.z_0 = final.z_0;
    out.load = final.load;
    const double noise = near.load.error + far.load.error;
    const bool at_target = solution || far.excess <= 2 * far.load.error;
    const bool jumps = !at_target && far.excess - near.excess > 2 * noise;
    out.status = jumps ? LoadStatus::load_jump : LoadStatus::reached;
    if (jumps) {
      out.jump_z_0 = near.z_0;
      out.jump_R_n = near.load.R_n;
    }
  }

  const LoadCurve& curve_;
  const LoadSearch& search_;
  std::vector<GapLoad> computed_;
  bool reaches_by_noise_ = false;  // a maximum of the load equals the target within its error
};

}  // namespace

LoadPoint first_crossing(const LoadCurve& curve, const LoadSearch& search) {
  return CrossingSearch(curve, search).run();
}

}  // namespace bristle
