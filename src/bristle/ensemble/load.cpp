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
    // The loads that have been computed since may show that the load is not even there.
    if (solution_ && !is_accepted(*solution_)) narrow(Accuracy::precise);
    if (!solution_) {
      // A jump, or the noise of the means: the reported loads decide.
      bracket_ = loads_.between(bracket_.near.z_0, bracket_.far.z_0, Accuracy::reported);
      if (!bracket_.encloses()) locate_again();
    }
    return result();
  }

 private:
  // The search may have refined the loads of these gaps since.
  LoadBracket refined(const LoadBracket& bracket) {
    return loads_.between(bracket.near.z_0, bracket.far.z_0, Accuracy::precise);
  }

  // Narrows the bracket to a gap at which the load is within rtol of the target, or to z_0_resolution.
  void narrow(Accuracy accuracy) {
    const auto width = [this] { return std::abs(bracket_.near.z_0 - bracket_.far.z_0); };
    solution_.reset();
    take_solution();
    int slow = 0;  // steps that did not halve the bracket, less those that did
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
    // No gap does better than one whose mean does not converge, if it is within its own error of the target.
    return distance <= loads_.allowed() || (!at.load.converged && distance <= at.load.error) ||
           (search_.by_secants && distance <= kEvenToleranceFactor * loads_.allowed() &&
            even_between(at.z_0));
  }

  // The nearest computed gaps on both sides of this one whose loads differ from its load beyond doubt, if the
  // load rises along the path from the first to the second with similar slopes.
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

  // The gap at which the inverse parabola, through both ends of the bracket and the gap nearest to it whose
  // load continues their order, has the load of the target; without such a gap, the secant.
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

  // A gap before the crossing whose load is above the target already: then the load between has a maximum and
  // a minimum. Looks at this distance, then twice as far each time, down to the near end of the scan's
  // bracket, unless a load computed already shows that the load falls as expected there.
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

  // Whether a load computed already, at about this distance before the crossing, is as far below the target
  // as with this slope.
  bool falls_before(double crossing, double distance, double slope) const {
    return std::ranges::any_of(loads_.computed(), [&](const GapLoad& one) {
      const double before = search_.path == LoadPath::loading ? one.z_0 - crossing : crossing - one.z_0;
      return distance / M_SQRT2 <= before && before <= M_SQRT2 * distance &&
             one.excess + kUndecidedErrors * one.load.error < -slope * before;
    });
  }

  // The reported loads at the ends of the bracket do not enclose the target, as the precise ones misled the
  // search. Locates the crossing by reported loads, between the bracket and an end of the scan's.
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
  std::optional<GapLoad> solution_;  // within rtol of the target
  bool by_noise_ = false;            // no reported loads enclose the target
};

// The first gap before the crossing with a load that is below the target by no more than decides, if the load
// falls again between that gap and the crossing.
std::optional<double> undecided_before(LoadsOnPath& loads, double crossing) {
  std::vector<GapLoad> before;
  for (const GapLoad& one : loads.computed())
    if (loads.is_before(one.z_0, crossing)) before.push_back(one);
  std::ranges::stable_sort(before,
                           [&](const GapLoad& a, const GapLoad& b) { return loads.is_before(a.z_0, b.z_0); });
  const auto below = [&](const GapLoad& one) { return one.excess < -loads.undecided(one); };
  while (!before.empty() && !below(before.back())) before.pop_back();  // the slope to the crossing
  for (const GapLoad& one : before) {
    if (below(one)) continue;
    const GapLoad precise = loads.at(one.z_0, Accuracy::precise);
    if (!below(precise)) return precise.z_0;
  }
  return {};
}

// The gap beyond the crossing at which the load is below the target beyond doubt, if before that gap it has
// not been above it beyond doubt.
std::optional<double> falls_beyond(LoadsOnPath& loads, double crossing) {
  const double end =
      loads.search.path == LoadPath::loading ? loads.search.ground : loads.search.first_contact;
  const auto above = [&](const GapLoad& at) { return at.excess > loads.undecided(at); };
  GapLoad last = loads.at(crossing, Accuracy::precise);
  while (!above(last) && loads.is_before(last.z_0, end)) {
    // The next gap: that of a load computed already, or an eighth of the scan's step further.
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

// The first crossing. other: whether to look for another gap that might be it.
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
