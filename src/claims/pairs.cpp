// The predicates that count pairs of points: Kendall's tau of one quantity or two, and the order of values.
#include "claims/predicates.hpp"

#include "bristle/model/elementary.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace bristle::claims {
namespace {

// Counts numbers below a bound: a binary indexed tree (P. M. Fenwick, Software: Practice and Experience 24,
// 1994) over all numbers that are to be inserted.
class Counter {
 public:
  explicit Counter(std::vector<double> numbers) : numbers_(std::move(numbers)), counts_(numbers_.size() + 1) {
    std::ranges::sort(numbers_);
  }
  void insert(double number) {
    for (std::size_t i = rank(number) + 1; i < counts_.size(); i += i & -i) ++counts_[i];
  }
  // Returns how many of the inserted numbers are below the bound.
  long below(double bound) const {
    long count = 0;
    for (std::size_t i = rank(bound); i > 0; i -= i & -i) count += counts_[i];
    return count;
  }

 private:
  std::size_t rank(double number) const {
    return std::size_t(std::ranges::lower_bound(numbers_, number) - numbers_.begin());
  }

  std::vector<double> numbers_;
  std::vector<long> counts_;
};

// Pairs of points, counted for Kendall's tau.
struct Pairs {
  long rising = 0, falling = 0, all = 0;
  double variance = 0;  // variance of rising - falling if there is no association

  // Adds one pair with this change of the value; it neither rises nor falls within its error.
  void add(double change, double error) {
    ++all;
    rising += change > error;
    falling += change < -error;
  }
  void add(const Pairs& other, long times) {
    rising += times * other.rising;
    falling += times * other.falling;
    all += times * other.all;
  }
  // Adds the variance of the pairs of n points before the jump and m points behind it.
  void add_points(double n, double m, PointPairs counted) {
    const auto of_all = [](double k) { return k * (k - 1) * (2 * k + 5) / 18; };
    variance += counted == PointPairs::all      ? of_all(n + m)
                : counted == PointPairs::within ? of_all(n) + of_all(m)
                                                : n * m * (n + m + 1) / 3;
  }
  Measurement measurement(std::size_t curves, std::size_t missing) const {
    Measurement out;
    out.curves = curves;
    out.missing = missing;
    if (all == 0) return out;
    const auto difference = double(rising - falling);
    out.value = difference / double(all);
    out.error = double(all - rising - falling) / double(all);
    out.significance = erfc(std::abs(difference) / std::sqrt(2 * variance));
    return out;
  }
};

// Returns all pairs of these points. A pair rises or falls if neither the errors of the abscissae nor the
// errors of the values overlap.
Pairs pairs_of(Curve points) {
  Pairs out;
  out.all = long(points.size()) * (long(points.size()) - 1) / 2;
  const auto left = [](const CurvePoint& p) { return p.x - p.x_error; };
  const auto right = [](const CurvePoint& p) { return p.x + p.x_error; };
  const auto low = [](const CurvePoint& p) { return p.value - p.error; };
  const auto high = [](const CurvePoint& p) { return p.value + p.error; };
  std::erase_if(points, [&](const CurvePoint& p) {
    return !std::isfinite(left(p) + right(p)) || !std::isfinite(low(p) + high(p));
  });
  std::vector<double> tops, negative_bottoms;
  for (const CurvePoint& p : points) {
    tops.push_back(high(p));
    negative_bottoms.push_back(-low(p));
  }
  Counter by_top(tops), by_bottom(negative_bottoms);
  Curve by_right = points;
  std::ranges::sort(by_right, {}, right);
  std::ranges::sort(points, {}, left);
  auto next = by_right.begin();  // the first point that is not to the left of p
  for (const CurvePoint& p : points) {
    for (; next != by_right.end() && right(*next) < left(p); ++next) {
      by_top.insert(high(*next));
      by_bottom.insert(-low(*next));
    }
    out.rising += by_top.below(low(p));
    out.falling += by_bottom.below(-high(p));
  }
  return out;
}

}  // namespace

Measurement trend(const Curves& in, PointPairs counted) {
  Pairs pairs;
  std::size_t used = 0;
  for (const Curve& curve : in.curves) {
    if (curve.size() >= 2) ++used;
    Curve before, behind;
    std::ranges::partition_copy(curve, std::back_inserter(behind), std::back_inserter(before),
                                &CurvePoint::behind_jump);
    pairs.add_points(double(before.size()), double(behind.size()), counted);
    if (counted != PointPairs::within) pairs.add(pairs_of(curve), 1);
    if (counted == PointPairs::all) continue;
    for (const Curve& side : {before, behind})
      pairs.add(pairs_of(side), counted == PointPairs::within ? 1 : -1);
  }
  return pairs.measurement(used, in.missing);
}

Measurement concordance(const Curve& first, const Curve& second) {
  Curves joint{{{}}, 0};
  for (std::size_t i = 0; i < first.size(); ++i) {
    const bool values = std::isfinite(first[i].value) && std::isfinite(second[i].value);
    if (values) joint.curves[0].push_back({first[i].value, second[i].value, second[i].error, first[i].error});
    else ++joint.missing;
  }
  return trend(joint);
}

Measurement ordering(const Curve& first, const Curve& second) {
  Pairs pairs;
  std::size_t missing = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (std::isfinite(first[i].value) && std::isfinite(second[i].value))
      pairs.add(first[i].value - second[i].value, first[i].error + second[i].error);
    else ++missing;
  }
  Measurement out = pairs.measurement(2, missing);
  out.significance = NAN;  // only a rank correlation has one
  return out;
}

}  // namespace bristle::claims
