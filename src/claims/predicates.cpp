#include "claims/predicates.hpp"

#include "bristle/model/elementary.hpp"

#include <algorithm>
#include <cmath>

namespace bristle::claims {
namespace {

double relative_error(const CurvePoint& p) { return p.error / std::abs(p.value); }

// Adds errors: in quadrature if they are independent, otherwise linearly.
class ErrorSum {
 public:
  explicit ErrorSum(bool independent) : independent_(independent) {}
  void add(double error) { sum_ += independent_ ? error * error : std::abs(error); }
  double value() const { return independent_ ? std::sqrt(sum_) : sum_; }

 private:
  bool independent_;
  double sum_ = 0;
};

// Returns the mean over the curves with at least least_points points. of_curve returns the number of one
// curve.
template <class OfCurve>
Measurement mean_over(const Curves& in, OfCurve of_curve, std::size_t least_points = 2) {
  double sum = 0;
  ErrorSum error(in.independent);
  std::size_t used = 0;
  for (const Curve& curve : in.curves) {
    if (curve.size() < least_points) continue;
    const Quantity one = of_curve(curve);
    sum += one.value;
    error.add(one.error);
    ++used;
  }
  Measurement out;
  out.missing = in.missing;
  out.curves = used;
  if (used == 0) return out;
  out.value = sum / double(used);
  out.error = error.value() / double(used);
  return out;
}

// Returns ln of the ratio of two values.
Quantity log_ratio(const CurvePoint& a, const CurvePoint& b) {
  return {log(a.value / b.value), relative_error(a) + relative_error(b)};
}

Measurement exponential(Measurement m) {
  m.value = exp(m.value);
  m.error *= m.value;
  return m;
}

Measurement mean_log_range(const Curves& in) {
  return mean_over(in, [](const Curve& curve) {
    const auto [low, high] = std::ranges::minmax_element(curve, {}, &CurvePoint::value);
    return Quantity{log(high->value / low->value), relative_error(*low) + relative_error(*high)};
  });
}

// Returns the slopes of ln(value) over ln(abscissa) between neighbouring points, with their errors.
std::vector<Quantity> log_slopes(const Curve& curve) {
  std::vector<Quantity> out;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const double run = log(curve[i].x / curve[i - 1].x);
    out.push_back({log(curve[i].value / curve[i - 1].value) / run,
                   (relative_error(curve[i]) + relative_error(curve[i - 1])) / std::abs(run)});
  }
  return out;
}

std::size_t steepest(const std::vector<Quantity>& slopes) {
  return std::size_t(std::ranges::min_element(slopes, {}, &Quantity::value) - slopes.begin());
}

// Returns ln(abscissa) at which the curve first falls to a level after the point `from`. The uncertainty is
// half the distance of the points there.
Quantity falls_to(const Curve& curve, std::size_t from, double level) {
  for (std::size_t i = from + 1; i < curve.size(); ++i) {
    if (curve[i].value > level) continue;
    const double a = log(curve[i - 1].x), b = log(curve[i].x);
    const double share = (curve[i - 1].value - level) / (curve[i - 1].value - curve[i].value);
    return {a + share * (b - a), std::abs(b - a) / 2};
  }
  return {NAN, NAN};
}

}  // namespace

Measurement rise(const Curves& in) {
  return mean_over(in, [](const Curve& curve) { return log_ratio(curve.back(), curve.front()); });
}

Measurement end_ratio(const Curves& in) { return exponential(rise(in)); }

Measurement share(const Curves& in) {
  double part = 0, whole = 0;
  ErrorSum part_error(in.independent), whole_error(in.independent);
  Measurement out;
  out.missing = in.missing;
  out.curves = 0;
  for (const Curve& curve : in.curves) {
    if (curve.size() < 2) continue;
    const CurvePoint &first = curve.front(), &last = curve.back();
    const auto [change, error, load_error] = log_ratio(last, first);
    part += change;
    part_error.add(error);
    whole += log(last.x / first.x);
    whole_error.add(last.x_error / last.x + first.x_error / first.x);
    ++out.curves;
  }
  out.value = part / whole;
  out.error = (part_error.value() + std::abs(out.value) * whole_error.value()) / std::abs(whole);
  return out;
}

Measurement third_ratio(const Curves& in) {
  return exponential(mean_over(in, [](const Curve& curve) {
    const std::size_t third = std::max<std::size_t>(1, curve.size() / 3);
    Quantity out{0, 0};
    for (std::size_t i = 0; i < third; ++i) {
      const auto [change, error, load_error] = log_ratio(curve[curve.size() - third + i], curve[i]);
      out.value += change / double(third);
      out.error += error / double(third);
    }
    return out;
  }));
}

Measurement top_ratio(const Curves& in) {
  return exponential(mean_over(in, [](const Curve& curve) {
    return log_ratio(*std::ranges::max_element(curve, {}, &CurvePoint::value), curve.front());
  }));
}

Measurement range_ratio(const Curves& along, const Curves& against) {
  Measurement a = mean_log_range(along);
  const Measurement b = mean_log_range(against);
  const double ratio = a.value / b.value;
  a.error = ratio * (a.error / a.value + b.error / b.value);
  a.value = ratio;
  a.curves += b.curves;
  return a;
}

namespace {

// The least-squares line of points: its slope, the error of the slope, and the means of the coordinates.
struct Line {
  double slope = 0, slope_error = 0, x_mean = 0, y_mean = 0;
};

Line fitted(const std::vector<CurvePoint>& points, bool independent) {
  const auto n = double(points.size());
  Line line;
  double squares = 0;
  for (const CurvePoint& p : points) {
    line.x_mean += p.x / n;
    line.y_mean += p.value / n;
  }
  for (const CurvePoint& p : points) squares += (p.x - line.x_mean) * (p.x - line.x_mean);
  for (const CurvePoint& p : points) line.slope += (p.x - line.x_mean) / squares * p.value;
  ErrorSum error(independent);
  for (const CurvePoint& p : points)
    error.add((p.x - line.x_mean) / squares * (p.error + std::abs(line.slope) * p.x_error));
  line.slope_error = error.value();
  return line;
}

Curve logarithms(Curve curve) {
  for (CurvePoint& p : curve)
    p = {log(p.x), log(p.value), relative_error(p), p.x_error / std::abs(p.x), p.behind_jump};
  return curve;
}

}  // namespace

Measurement slope(const Curves& in, bool logarithmic) {
  return mean_over(in, [logarithmic, &in](const Curve& curve) {
    const Line line = fitted(logarithmic ? logarithms(curve) : curve, in.independent);
    return Quantity{line.slope, line.slope_error};
  });
}

Measurement linearity(const Curves& in) {
  const auto of_curve = [&in](const Curve& curve) {
    const Line line = fitted(curve, in.independent);
    double squares = 0, error = 0;
    for (const CurvePoint& p : curve) {
      const double apart = p.value - line.y_mean - line.slope * (p.x - line.x_mean);
      squares += apart * apart / double(curve.size());
      error = std::max(error, p.error);
    }
    const auto [left, right] = std::ranges::minmax(curve, {}, &CurvePoint::x);
    const double range = std::abs(line.slope) * (right.x - left.x);
    return Quantity{std::sqrt(squares) / range, error / range};
  };
  return mean_over(in, of_curve, 3);  // two points always lie on a line
}

Measurement plateau(const Curves& in) {
  return mean_over(in, [](const Curve& curve) {
    const auto [low, high] = std::ranges::minmax_element(curve, {}, &CurvePoint::value);
    double mean = 0;
    for (const CurvePoint& p : curve) mean += p.value / double(curve.size());
    return Quantity{(high->value - low->value) / mean, (high->error + low->error) / mean};
  });
}

Measurement level(const Curves& in) {
  Measurement out;
  out.missing = in.missing;
  double sum = 0;
  ErrorSum uncertainty(in.independent);
  std::size_t points = 0;
  for (const Curve& curve : in.curves) {
    for (const CurvePoint& p : curve) {
      sum += p.value;
      uncertainty.add(p.error);
      ++points;
    }
    ++out.curves;
  }
  if (points == 0) return out;
  out.value = sum / double(points);
  out.error = uncertainty.value() / double(points);
  return out;
}

Measurement steepest_fall(const Curves& in) {
  return mean_over(in, [](const Curve& curve) {
    const auto slopes = log_slopes(curve);
    const std::size_t at = steepest(slopes);
    std::size_t from = at, to = at;
    for (std::size_t i = 0; i < slopes.size(); ++i)
      if (slopes[i].value - slopes[i].error <= slopes[at].value + slopes[at].error) {
        from = std::min(from, i);
        to = std::max(to, i);
      }
    const double place = std::sqrt(curve[at].x * curve[at + 1].x);
    return Quantity{place, std::max(place - curve[from].x, curve[to + 1].x - place)};
  });
}

Measurement steepness(const Curves& in) {
  return mean_over(in, [](const Curve& curve) {
    const auto slopes = log_slopes(curve);
    const Quantity& s = slopes[steepest(slopes)];
    return Quantity{-s.value, s.error};
  });
}

Measurement fall_width(const Curves& in) {
  return mean_over(in, [](const Curve& curve) {
    const auto high = std::ranges::max_element(curve, {}, &CurvePoint::value);
    const auto low = std::ranges::min_element(high, curve.end(), {}, &CurvePoint::value);
    const double range = high->value - low->value;
    const auto from = std::size_t(high - curve.begin());
    const Quantity begin = falls_to(curve, from, high->value - range / 4);
    const Quantity end = falls_to(curve, from, high->value - 3 * range / 4);
    return Quantity{end.value - begin.value, begin.error + end.error};
  });
}

namespace {

// Returns the smaller difference between a point and its neighbours: by about so much a curve may exceed an
// extreme point beside it. 0 at the ends.
double beyond_point(const Curve& curve, std::size_t i) {
  if (i == 0 || i + 1 == curve.size()) return 0;
  return std::min(std::abs(curve[i].value - curve[i - 1].value),
                  std::abs(curve[i].value - curve[i + 1].value));
}

}  // namespace

Measurement fold(const Curves& in) {
  Measurement out;
  out.missing = in.missing;
  for (const Curve& curve : in.curves) {
    if (curve.size() < 2) continue;
    ++out.curves;
    std::size_t top = curve.size() - 1;
    for (std::size_t i = curve.size(); i-- > 0;) {
      if (curve[i].value > curve[top].value) top = i;
      const double highest = curve[top].value, drop = (highest - curve[i].value) / highest;
      if (drop <= out.value) continue;
      out.value = drop;
      out.error =
          (curve[top].error + curve[i].error + beyond_point(curve, top) + beyond_point(curve, i)) / highest;
    }
    if (!(out.value >= 0)) out.value = out.error = 0;
  }
  return out;
}

Measurement equality(const Curve& first, const Curve& second, double resolution) {
  Measurement out;
  double squares = 0, errors = 0;
  std::size_t n = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double error = std::sqrt(first[i].error * first[i].error + second[i].error * second[i].error);
    const double units = (first[i].value - second[i].value) / error;
    if (!std::isfinite(units)) {
      ++out.missing;
      continue;
    }
    squares += units * units;
    errors += error;
    ++n;
  }
  out.curves = 2;
  if (n == 0) return out;
  out.value = std::sqrt(squares / double(n));
  const bool resolved = errors / double(n) <= resolution;
  out.error = resolved ? 1 / std::sqrt(2 * double(n)) : INFINITY;
  return out;
}

}  // namespace bristle::claims
