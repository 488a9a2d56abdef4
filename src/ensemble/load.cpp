#include "ensemble/load.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace bristle {
namespace {

struct NotComputable {};

// A load is above or below the target if its distance exceeds this multiple of its error.
constexpr double kDistinct = 2;
// A load may be that of the target if its distance is below this multiple of its error; the errors of means
// that are decided are smaller.
constexpr double kMaybe = 3;
// Distance before a crossing, in steps of the scan, at which the load is checked to be below the target.
constexpr double kNeighbour = 0.125;
// Before a crossing, R_n is expected to fall at least by this share of its mean slope in the scan's bracket.
constexpr double kEven = 0.75;
// Slow steps of the root-finder, in excess of the others, after which it bisects.
constexpr int kMaxSlow = 3;
// A bracket narrower than this, in steps of the scan, should have led to the target already: it contains a
// jump, or the noise of the means misled the search.
constexpr double kNarrow = 1. / 64;
// A hump is searched if it may reach the target to within this share of the target, in at most kHumpSteps
// steps.
constexpr double kHumpBelow = 0.05;
constexpr int kHumpSteps = 4;
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
      if (!scanned.empty()) examine_top(scanned.back(), far);
      return bracket_before(out, far, scanned);
    }
    return false;
  }

  double allowed() const { return search_.rtol * search_.target; }

  // Whether the load at this gap equals the target within its tolerance or its error.
  bool near_target(const GapLoad& at) {
    if (std::abs(at.excess) > allowed() + kMaybe * at.load.error) return false;
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
  void examine_top(const GapLoad& before, const GapLoad& at) {
    if (!near_target(at)) return;
    const GapLoad next = next_of_scan(at.z_0, Accuracy::rough);
    if (next.excess < 0) top_of_hump(before, at, next);
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

  // If b is the top of a hump, searches between a and c for a gap with excess >= 0.
  std::optional<GapLoad> find_in_hump(const GapLoad& a, const GapLoad& b, const GapLoad& c) {
    const double noise = a.load.error + b.load.error + c.load.error;
    const bool hump = b.excess < 0 && c.excess < 0 && b.excess >= std::max(a.excess, c.excess) - noise;
    if (!hump) return {};
    const GapLoad top = top_of_hump(a, b, c);
    if (top.excess < 0) return {};
    return top;
  }

  // The top of the parabola through the loads at equidistant gaps, of which b has the largest load, and its
  // error.
  static double parabola_top(const GapLoad& a, const GapLoad& b, const GapLoad& c) {
    const double rise = std::max(0.0, b.excess - a.excess), fall = std::max(0.0, b.excess - c.excess);
    return b.excess + (rise - fall) * (rise - fall) / (8 * (rise + fall) + 1e-300) + b.load.error;
  }

  // The largest load found between two gaps on both sides of top, or the first that is above the target
  // beyond doubt. The distance between the gaps is halved as long as the parabola through the loads may reach
  // the target.
  GapLoad top_of_hump(GapLoad a, GapLoad top, GapLoad c) {
    const auto found = [&] { return top.excess > allowed() + kDistinct * top.load.error; };
    const auto between = [&](const GapLoad& one, const GapLoad& other) {
      const double z_0 = one.z_0 + (other.z_0 - one.z_0) / 2;
      const GapLoad probe = load_at(z_0, Accuracy::rough);
      return probe.excess < 0 ? probe : load_at(z_0, Accuracy::precise);
    };
    for (int i = 0; i < kHumpSteps && !found(); ++i) {
      if (parabola_top(a, top, c) < -kHumpBelow * search_.target) return top;
      const GapLoad left = between(a, top), right = between(top, c);
      if (left.excess > std::max(top.excess, right.excess)) c = std::exchange(top, left);
      else if (right.excess > top.excess) a = std::exchange(top, right);
      else a = left, c = right;
    }
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
    const auto width = [&b] { return std::abs(b.near.z_0 - b.far.z_0); };
    take_solution(b);
    int slow = 0;  // steps that did not halve the bracket, less those that did
    bool examined = accuracy == Accuracy::reported;
    while (!b.solution && width() > search_.z_0_resolution) {
      if (slow >= kMaxSlow && !examined && width() < kNarrow * search_.step) {
        b = bracket_of(b.near.z_0, b.far.z_0, Accuracy::reported);
        take_solution(b);
        if (b.solution || !encloses(b)) return;
        examined = true;
      }
      const double before = width();
      const GapLoad probe = load_at(slow < kMaxSlow ? interpolated(b) : middle(b), accuracy);
      (probe.excess < 0 ? b.near : b.far) = probe;
      take_solution(b);
      slow = width() > before / 2 ? slow + 1 : std::max(0, slow - 1);
    }
  }

  void take_solution(Bracket& b) const {
    for (const GapLoad& end : {b.near, b.far})
      if (std::abs(end.excess) <= allowed()) b.solution = end;
  }

  static bool encloses(const Bracket& b) { return b.near.excess < 0 && b.far.excess >= 0; }
  static double middle(const Bracket& b) { return b.near.z_0 + (b.far.z_0 - b.near.z_0) / 2; }

  // The gap at which the inverse parabola, through both ends of the bracket and the gap nearest to it whose
  // load continues their order, has the load of the target; without such a gap, the secant.
  double interpolated(const Bracket& b) const {
    const double run = b.far.z_0 - b.near.z_0, rise = b.far.excess - b.near.excess;
    const double secant = b.near.z_0 - b.near.excess * run / rise;
    const GapLoad* third = nullptr;
    for (const GapLoad& one : computed_) {
      const double along = (one.z_0 - b.near.z_0) / run;
      const double apart = along < 0 ? b.near.excess - one.excess : along > 1 ? one.excess - b.far.excess : 0;
      if (apart <= kDistinct * one.load.error) continue;
      if (!third || std::abs(one.z_0 - secant) <= std::abs(third->z_0 - secant)) third = &one;
    }
    if (!third) return secant;
    const double steepness = ((third->z_0 - b.far.z_0) / (third->excess - b.far.excess) - run / rise) /
                             (third->excess - b.near.excess);
    const double curved = secant + steepness * b.near.excess * b.far.excess;
    const double share = (curved - b.near.z_0) / run;
    return share > 0 && share < 1 ? curved : secant;
  }

  Bracket bracket_of(double near, double far, Accuracy accuracy) {
    return {load_at(near, accuracy), load_at(far, accuracy)};
  }

  void locate_crossing(LoadPoint& out) {
    Bracket b = bracket_of(out.z_0_near, out.z_0_far, Accuracy::precise);
    narrow(b, Accuracy::precise);
    double distance = kNeighbour * search_.step;
    for (int i = 0; b.solution && i < kMaxEarlier; ++i, distance /= 2) {
      const Bracket scan = bracket_of(out.z_0_near, out.z_0_far, Accuracy::precise);
      const auto earlier = earlier_crossing(scan, *b.solution, distance);
      if (!earlier) break;
      out.z_0_far = earlier->z_0;
      b = {scan.near, *earlier};
      narrow(b, Accuracy::precise);
    }
    if (b.solution && only_touches(b.solution->z_0, out.z_0_far)) reaches_by_noise_ = true;
    if (!b.solution) {
      // A jump, or the noise of the means: the reported loads decide.
      b = bracket_of(b.near.z_0, b.far.z_0, Accuracy::reported);
      if (!encloses(b)) b = located_again(b, out);
    }
    out.ambiguous = reaches_by_noise_;
    set_result(out, b.near, b.far, b.solution);
  }

  // Whether a load computed already, at about this distance before the crossing, is as far below the target
  // as with this slope.
  bool falls_before(double crossing, double distance, double slope) const {
    return std::any_of(computed_.begin(), computed_.end(), [&](const GapLoad& one) {
      const double before = search_.path == LoadPath::loading ? one.z_0 - crossing : crossing - one.z_0;
      return distance / 2 <= before && before <= 2 * distance &&
             one.excess + kDistinct * one.load.error < -slope * before;
    });
  }

  // A gap before the crossing whose load is above the target already: then the load between has a maximum and
  // a minimum. Starts at this distance and goes back along the path as long as the load falls less than
  // expected.
  std::optional<GapLoad> earlier_crossing(const Bracket& scan, const GapLoad& crossing, double distance) {
    const double slope = (scan.far.excess - scan.near.excess) / std::abs(scan.far.z_0 - scan.near.z_0);
    const double room = std::abs(scan.near.z_0 - crossing.z_0);
    for (; distance < room && !falls_before(crossing.z_0, distance, kEven * slope); distance *= 2) {
      const double z_0 = beyond(crossing.z_0, -distance);
      GapLoad probe = load_at(z_0, Accuracy::rough);
      if (probe.excess >= -kDistinct * probe.load.error) {
        probe = load_at(z_0, Accuracy::precise);
        if (probe.excess >= 0) return probe;
        // On an even slope the load there would be below the target beyond doubt.
        if (slope * distance > allowed() + kDistinct * probe.load.error && near_target(probe))
          reaches_by_noise_ = true;
      }
      if (probe.excess + probe.load.error < -kEven * slope * distance) break;
    }
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

  // The reported loads at the ends of b do not enclose the target, as the precise ones misled the search.
  // Locates the crossing by reported loads, between b and an end of the scan's bracket.
  Bracket located_again(const Bracket& b, const LoadPoint& out) {
    Bracket wide = b;
    if (b.near.excess >= 0) wide = {load_at(out.z_0_near, Accuracy::reported), b.near};
    else wide = {b.far, load_at(out.z_0_far, Accuracy::reported)};
    const double end = search_.path == LoadPath::loading ? search_.ground : search_.first_contact;
    while (wide.far.excess < 0 && wide.far.z_0 != end) {
      wide.near = wide.far;
      wide.far = next_of_scan(wide.far.z_0, Accuracy::reported);
    }
    if (encloses(wide)) narrow(wide, Accuracy::reported);
    else reaches_by_noise_ = true;
    return wide;
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
