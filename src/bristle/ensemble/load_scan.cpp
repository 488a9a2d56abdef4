#include "bristle/ensemble/load_path.hpp"
#include "bristle/ensemble/load_rules.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace bristle {
namespace {

std::vector<double> scan_gaps(const LoadSearch& search) {
  const double length = search.first_contact - search.ground;
  const int count = std::max(2, int(std::ceil(length / search.step)));
  std::vector<double> gaps;
  for (int i = 0; i <= count; ++i) gaps.push_back(search.first_contact - length * i / count);
  if (search.path == LoadPath::unloading) std::reverse(gaps.begin(), gaps.end());
  return gaps;
}

// Returns the excess at the top of the parabola through the loads at equidistant gaps, plus the error of the
// load at b, which is the largest of the three.
double parabola_top(const GapLoad& a, const GapLoad& b, const GapLoad& c) {
  const double rise = std::max(0.0, b.excess - a.excess), fall = std::max(0.0, b.excess - c.excess);
  return b.excess + (rise - fall) * (rise - fall) / (8 * (rise + fall) + 1e-300) + b.load.error;
}

// Searches the hump between the gaps a and c for its top, from the gap `top` between them. Halves the
// distance between the gaps as long as the parabola through the loads may reach the target. Returns the
// largest load found, or the first load above the target beyond doubt.
GapLoad top_of_hump(LoadsOnPath& loads, GapLoad a, GapLoad top, GapLoad c) {
  const auto found = [&] { return top.excess > loads.allowed() + kUndecidedErrors * top.load.error; };
  const auto between = [&](const GapLoad& one, const GapLoad& other) {
    const double z_0 = one.z_0 + (other.z_0 - one.z_0) / 2;
    const GapLoad probe = loads.at(z_0, Accuracy::rough);
    return probe.excess < 0 ? probe : loads.at(z_0, Accuracy::precise);
  };
  while (!found() && std::abs(c.z_0 - a.z_0) > 3 * kLeastHumpSteps * loads.search.step) {
    if (parabola_top(a, top, c) < -kHumpShare * loads.search.target) return top;
    const GapLoad left = between(a, top), right = between(top, c);
    if (left.excess > std::max(top.excess, right.excess)) c = std::exchange(top, left);
    else if (right.excess > top.excess) a = std::exchange(top, right);
    else a = left, c = right;
  }
  return top;
}

// Searches between a and c for a gap with excess >= 0 if b, between them, is the top of a hump. Returns none
// if it is not, or if there is no such gap.
std::optional<GapLoad> find_in_hump(LoadsOnPath& loads, const GapLoad& a, const GapLoad& b,
                                    const GapLoad& c) {
  const double noise = a.load.error + b.load.error + c.load.error;
  const bool hump = b.excess < 0 && c.excess < 0 && b.excess >= std::max(a.excess, c.excess) - noise;
  if (!hump) return {};
  const GapLoad top = top_of_hump(loads, a, b, c);
  if (top.excess < 0) return {};
  return top;
}

// Returns the first gap, going up from first contact, whose load is below the target, or the last gap tried
// if none is. The wall is soft: a load below R_n at first contact occurs a few wall ranges lambda_z above it.
GapLoad above_contact(LoadsOnPath& loads) {
  const LoadSearch& search = loads.search;
  GapLoad probe = loads.at(search.first_contact, Accuracy::precise);
  double height = search.contact_range;  // above first contact
  while (probe.load.R_n >= search.target && height < kWallRangesAboveContact * search.contact_range) {
    probe = loads.at(search.first_contact + height, Accuracy::precise);
    height *= 2;
  }
  return probe;
}

std::optional<LoadBracket> if_encloses(const LoadBracket& bracket) {
  if (bracket.encloses()) return bracket;
  return {};
}

// Brackets the crossing by the last scanned gap whose precise load has a negative excess and the gap after
// it. `far` is the gap after the scanned ones.
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

// Scans the path at gaps a step apart, and at finer ones where the load comes near the target.
class Scan {
 public:
  explicit Scan(LoadsOnPath& loads) : loads_(loads) {}

  // Returns the bracket of the first crossing. A crossing found with rough loads is confirmed with precise
  // loads.
  std::optional<LoadBracket> run() {
    const std::vector<double> gaps = scan_gaps(loads_.search);
    for (std::size_t i = 0; i < gaps.size(); ++i) {
      if (!scanned_.empty() && i + 1 < gaps.size() && is_far_below(scanned_.back()) &&
          is_far_below(loads_.at(gaps[i + 1], Accuracy::rough)))
        ++i;
      const GapLoad next = loads_.at(gaps[i], Accuracy::rough);
      if (!scanned_.empty()) {
        const GapLoad last = scanned_.back();
        if (const auto found = between(last, next)) return found;
      }
      if (const auto found = add(next)) return found;
    }
    if (loads_.search.path == LoadPath::loading) return {};
    return if_encloses({loads_.at(loads_.search.first_contact, Accuracy::precise), above_contact(loads_)});
  }

 private:
  bool is_far_below(const GapLoad& one) const {
    return loads_.search.path == LoadPath::loading && one.excess < -kSkipShare * loads_.search.target;
  }

  // Returns whether the scan needs a gap between `from` and `to`. `roughness` is the deviation of the loads
  // around them from straight lines.
  bool is_needed_between(const GapLoad& from, const GapLoad& to, double roughness) const {
    const double steps = std::abs(to.z_0 - from.z_0) / loads_.search.step, target = loads_.search.target;
    const double distance = -(to.excess < 0 ? std::max(from.excess, to.excess) : from.excess);
    return (steps > kLeastHalvingSteps && distance <= kHalvingShare * steps * target) ||
           (steps > kLeastMiddleSteps && distance <= kMiddleShare * target) ||
           (steps > kLeastDeviationSteps && distance <= kDeviationFactor * roughness);
  }

  // Scans between the neighbouring gaps `from` and `to`, in the order of the path. Returns the bracket of a
  // crossing, if any.
  std::optional<LoadBracket> between(const GapLoad& from, const GapLoad& to, double roughness = 0) {
    if (!is_needed_between(from, to, roughness)) return {};
    const GapLoad middle = loads_.at(from.z_0 + (to.z_0 - from.z_0) / 2, Accuracy::rough);
    const double error = middle.load.error + (from.load.error + to.load.error) / 2;
    const double deviation = std::max(0.0, std::abs(middle.excess - (from.excess + to.excess) / 2) - error);
    roughness = std::max(deviation, roughness / 2);
    if (const auto found = between(from, middle, roughness)) return found;
    if (const auto found = add(middle)) return found;
    return between(middle, to, roughness);
  }

  // Adds the next gap of the path. Returns the bracket of a crossing before that gap, or in the hump between
  // the last three gaps, if any.
  std::optional<LoadBracket> add(GapLoad next) {
    scanned_.push_back(next);
    const std::size_t n = scanned_.size();
    if (n >= 3)
      if (const auto far = find_in_hump(loads_, scanned_[n - 3], scanned_[n - 2], scanned_[n - 1])) {
        scanned_.resize(n - 2);
        return bracket_before(loads_, *far, scanned_);
      }
    if (next.excess < 0) return {};
    const GapLoad far = loads_.at(next.z_0, Accuracy::precise);
    if (far.excess < 0) {
      scanned_.back() = far;
      return {};
    }
    scanned_.pop_back();
    return bracket_before(loads_, far, scanned_);
  }

  LoadsOnPath& loads_;
  std::vector<GapLoad> scanned_;
};

}  // namespace

std::optional<LoadBracket> scan_for_crossing(LoadsOnPath& loads) { return Scan(loads).run(); }

}  // namespace bristle
