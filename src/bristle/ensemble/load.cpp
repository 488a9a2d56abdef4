#include "bristle/ensemble/load.hpp"

#include "bristle/ensemble/load_path.hpp"
#include "bristle/ensemble/load_rules.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace bristle {
namespace {

// Locates the crossing within the bracket of the scan.
class CrossingFinder {
 public:
  CrossingFinder(LoadsOnPath& loads, const LoadBracket& scan)
      : loads_(loads), search_(loads.search), scan_(scan), bracket_(refined(scan)) {}

  LoadPoint run() {
    narrow(Accuracy::precise);
    move_to_earlier_crossings();
    // Loads computed after the solution may show that the load is not even at its gap.
    if (solution_ && !is_accepted(*solution_)) narrow(Accuracy::precise);
    if (!solution_) {
      // A jump, or the noise of the means: the reported loads decide.
      bracket_ = loads_.between(bracket_.near.z_0, bracket_.far.z_0, Accuracy::reported);
      if (!bracket_.encloses()) locate_again();
    }
    return result();
  }

 private:
  // Returns the bracket with the latest loads of its gaps: the search may have refined them.
  LoadBracket refined(const LoadBracket& bracket) {
    return loads_.between(bracket.near.z_0, bracket.far.z_0, Accuracy::precise);
  }

  // Narrows the bracket until the load at one of its ends is accepted (is_accepted()) or the bracket is as
  // narrow as z_0_resolution.
  void narrow(Accuracy accuracy) {
    const auto width = [this] { return std::abs(bracket_.near.z_0 - bracket_.far.z_0); };
    solution_.reset();
    take_solution();
    int slow = 0;  // steps that did not halve the bracket, minus the steps that did
    bool examined = accuracy == Accuracy::reported;
    while (!solution_ && width() > search_.z_0_resolution) {
      if (slow >= kMaxSlowSteps && !examined && width() < kSuspectBracketSteps * search_.step) {
        bracket_ = loads_.between(bracket_.near.z_0, bracket_.far.z_0, Accuracy::reported);
        take_solution();
        if (solution_ || !bracket_.encloses()) return;
        examined = true;
      }
      const double before = width();
      const double middle = bracket_.near.z_0 + (bracket_.far.z_0 - bracket_.near.z_0) / 2;
      const GapLoad probe = loads_.at(slow < kMaxSlowSteps ? interpolated() : middle, accuracy);
      (probe.excess < 0 ? bracket_.near : bracket_.far) = probe;
      take_solution();
      slow = width() > before / 2 ? slow + 1 : std::max(0, slow - 1);
    }
  }

  void take_solution() {
    for (const GapLoad& end : {bracket_.near, bracket_.far})
      if (is_accepted(end)) solution_ = end;
  }

  bool is_accepted(const GapLoad& at) const {
    const double distance = std::abs(at.excess);
    // A mean that does not converge is accepted within its own error of the target: other gaps do no better.
    return distance <= loads_.allowed() || (!at.load.converged && distance <= at.load.error) ||
           (search_.by_secants && distance <= kEvenToleranceFactor * loads_.allowed() &&
            even_between(at.z_0));
  }

  // Returns the computed gaps on both sides of z_0 that are nearest to it among the gaps whose loads differ
  // from the load at z_0 beyond doubt. Returns none unless the load rises along the path with similar slopes
  // from the first to z_0 and from z_0 to the second.
  std::optional<std::array<double, 2>> even_between(double z_0) const {
    const auto& computed = loads_.computed();
    const GapLoad at =
        *std::find_if(computed.rbegin(), computed.rend(), [&](const GapLoad& one) { return one.z_0 == z_0; });
    const auto apart = [&](const GapLoad& one) { return std::abs(one.z_0 - z_0); };
    std::array<const GapLoad*, 2> sides{};
    for (const GapLoad& one : computed) {
      if (one.z_0 == z_0 || apart(one) > search_.step ||
          std::abs(one.excess - at.excess) <= kUndecidedErrors * (one.load.error + at.load.error))
        continue;
      const GapLoad*& side = sides[loads_.is_before(one.z_0, z_0) ? 0 : 1];
      if (!side || apart(one) <= apart(*side)) side = &one;
    }
    if (!sides[0] || !sides[1]) return {};
    const double before = (at.excess - sides[0]->excess) / apart(*sides[0]);
    const double after = (sides[1]->excess - at.excess) / apart(*sides[1]);
    if (std::min(before, after) * kSlopeRatio < std::max(before, after)) return {};
    return std::array{sides[0]->z_0, sides[1]->z_0};
  }

  // Returns the gap of the target load on the inverse parabola through three points: the ends of the bracket
  // and the computed gap nearest to the secant's result whose load continues their order. Returns the result
  // of the secant if there is no such gap or the parabola leaves the bracket.
  double interpolated() const {
    const auto& [near, far] = bracket_;
    const double run = far.z_0 - near.z_0, rise = far.excess - near.excess;
    const double secant = near.z_0 - near.excess * run / rise;
    const GapLoad* third = nullptr;
    for (const GapLoad& one : loads_.computed()) {
      const double along = (one.z_0 - near.z_0) / run;
      const double apart = along < 0 ? near.excess - one.excess : along > 1 ? one.excess - far.excess : 0;
      if (apart <= kUndecidedErrors * one.load.error) continue;
      if (!third || std::abs(one.z_0 - secant) <= std::abs(third->z_0 - secant)) third = &one;
    }
    if (!third) return secant;
    const double steepness =
        ((third->z_0 - far.z_0) / (third->excess - far.excess) - run / rise) / (third->excess - near.excess);
    const double curved = secant + steepness * near.excess * far.excess;
    const double share = (curved - near.z_0) / run;
    return share > 0 && share < 1 ? curved : secant;
  }

  void move_to_earlier_crossings() {
    double distance = kFirstLookSteps * search_.step;
    for (int i = 0; solution_ && i < kMaxEarlierCrossings; ++i, distance /= 2) {
      scan_ = refined(scan_);
      const auto earlier = earlier_crossing(*solution_, distance);
      if (!earlier) return;
      bracket_ = scan_ = {scan_.near, *earlier};
      narrow(Accuracy::precise);
    }
  }

  // Finds a gap before the crossing whose load has reached the target: between it and the crossing the load
  // then has a maximum and a minimum. Looks at `distance` before the crossing, then twice as far each time,
  // up to the near end of the scan's bracket. Skips a distance at which a computed load already falls as
  // expected.
  std::optional<GapLoad> earlier_crossing(const GapLoad& crossing, double distance) {
    const double slope = (scan_.far.excess - scan_.near.excess) / std::abs(scan_.far.z_0 - scan_.near.z_0);
    const double room = std::abs(scan_.near.z_0 - crossing.z_0);
    for (; distance < room; distance *= 2) {
      if (falls_before(crossing.z_0, distance, kExpectedSlopeShare * slope)) continue;
      const double z_0 = loads_.beyond(crossing.z_0, -distance);
      GapLoad probe = loads_.at(z_0, Accuracy::rough);
      if (probe.excess >= -kUndecidedErrors * probe.load.error) {
        probe = loads_.at(z_0, Accuracy::precise);
        if (probe.excess >= 0) return probe;
      }
    }
    return {};
  }

  // Returns whether a load that was computed at about `distance` before the crossing is at least as far below
  // the target as a load that falls with this slope.
  bool falls_before(double crossing, double distance, double slope) const {
    return std::ranges::any_of(loads_.computed(), [&](const GapLoad& one) {
      const double before = search_.path == LoadPath::loading ? one.z_0 - crossing : crossing - one.z_0;
      return distance / M_SQRT2 <= before && before <= M_SQRT2 * distance &&
             one.excess + kUndecidedErrors * one.load.error < -slope * before;
    });
  }

  // Locates the crossing by reported loads, between the bracket and an end of the scan's bracket. Called if
  // the noise of the precise loads misled the search, so that the reported loads at the ends of the bracket
  // do not enclose the target.
  void locate_again() {
    if (bracket_.near.excess >= 0) bracket_ = {loads_.at(scan_.near.z_0, Accuracy::reported), bracket_.near};
    else bracket_ = {bracket_.far, loads_.at(scan_.far.z_0, Accuracy::reported)};
    const double end = search_.path == LoadPath::loading ? search_.ground : search_.first_contact;
    while (bracket_.far.excess < 0 && bracket_.far.z_0 != end) {
      bracket_.near = bracket_.far;
      bracket_.far = loads_.one_step_beyond(bracket_.far.z_0, Accuracy::reported);
    }
    if (bracket_.encloses()) narrow(Accuracy::reported);
    else by_noise_ = true;
  }

  LoadPoint result() const {
    const GapLoad& final = solution_ ? *solution_ : bracket_.far;
    LoadPoint out;
    out.z_0 = final.z_0;
    out.load = final.load;
    out.z_0_near = scan_.near.z_0;
    out.z_0_far = scan_.far.z_0;
    out.ambiguous = by_noise_;
    if (solution_ && search_.by_secants) out.even_between = even_between(final.z_0);
    const double noise = bracket_.near.load.error + bracket_.far.load.error;
    const bool at_target = solution_ || bracket_.far.excess <= 2 * bracket_.far.load.error;
    const bool jumps = !at_target && bracket_.far.excess - bracket_.near.excess > 2 * noise;
    out.status = jumps ? LoadStatus::load_jump : LoadStatus::reached;
    if (jumps) {
      out.jump_z_0 = bracket_.near.z_0;
      out.jump_R_n = bracket_.near.load.R_n;
    }
    return out;
  }

  LoadsOnPath& loads_;
  const LoadSearch& search_;
  LoadBracket scan_, bracket_;
  std::optional<GapLoad> solution_;  // see is_accepted()
  bool by_noise_ = false;            // no reported loads enclose the target
};

// Finds the first gap before the crossing whose load may, within its error or 0.5 %, already reach the
// target, provided that the load drops clearly below the target again before the crossing.
std::optional<double> undecided_before(LoadsOnPath& loads, double crossing) {
  std::vector<GapLoad> before;
  for (const GapLoad& one : loads.computed())
    if (loads.is_before(one.z_0, crossing)) before.push_back(one);
  std::ranges::stable_sort(before,
                           [&](const GapLoad& a, const GapLoad& b) { return loads.is_before(a.z_0, b.z_0); });
  const auto below = [&](const GapLoad& one) { return one.excess < -loads.undecided(one); };
  while (!before.empty() && !below(before.back())) before.pop_back();  // gaps on the rise to the crossing
  for (const GapLoad& one : before) {
    if (below(one)) continue;
    const GapLoad precise = loads.at(one.z_0, Accuracy::precise);
    if (!below(precise)) return precise.z_0;
  }
  return {};
}

// Finds the gap beyond the crossing at which the load is below the target beyond doubt, provided that the
// load is nowhere above the target beyond doubt between the crossing and that gap.
std::optional<double> falls_beyond(LoadsOnPath& loads, double crossing) {
  const double end =
      loads.search.path == LoadPath::loading ? loads.search.ground : loads.search.first_contact;
  const auto above = [&](const GapLoad& at) { return at.excess > loads.undecided(at); };
  GapLoad last = loads.at(crossing, Accuracy::precise);
  while (!above(last) && loads.is_before(last.z_0, end)) {
    // The next gap is the nearest one with a computed load, but at most an eighth of the scan's step further.
    double next = loads.beyond(last.z_0, loads.search.step / 8);
    if (!loads.is_before(next, end)) next = end;
    for (const GapLoad& one : loads.computed())
      if (loads.is_before(last.z_0, one.z_0) && loads.is_before(one.z_0, next)) next = one.z_0;
    GapLoad at = loads.at(next, Accuracy::rough);
    if (std::abs(at.excess) <= loads.undecided(at) &&
        loads.undecided(at) > kRoughErrorShare * loads.search.target)
      at = loads.at(next, Accuracy::precise);
    if (at.excess < -loads.undecided(at)) {
      const GapLoad between = loads.at(last.z_0 + (next - last.z_0) / 2, Accuracy::precise);
      return above(between) ? std::optional<double>() : next;
    }
    last = at;
  }
  return {};
}

// Finds the first crossing and, if `other` is true, another gap that may be the first crossing.
LoadPoint search_crossing(const LoadCurve& curve, const LoadSearch& search, bool other) {
  LoadsOnPath loads(curve, search);
  const auto bracket = scan_for_crossing(loads);
  if (!bracket) return {};
  LoadPoint out = CrossingFinder(loads, *bracket).run();
  if (!other) return out;
  out.z_0_other = undecided_before(loads, out.z_0);
  if (out.z_0_other) out.ambiguous = true;
  else if (const auto fallen = falls_beyond(loads, out.z_0)) {
    out.ambiguous = true;
    LoadSearch rest = search;
    (search.path == LoadPath::loading ? rest.first_contact : rest.ground) = *fallen;
    const LoadPoint next = search_crossing(curve, rest, false);
    if (next.status != LoadStatus::unreachable) out.z_0_other = next.z_0;
  }
  return out;
}

}  // namespace

LoadPoint first_crossing(const LoadCurve& curve, const LoadSearch& search) {
  try {
    return search_crossing(curve, search, true);
  } catch (const LoadsOnPath::NotComputable&) {
    LoadPoint out;
    out.status = LoadStatus::failed;
    return out;
  }
}

}  // namespace bristle
