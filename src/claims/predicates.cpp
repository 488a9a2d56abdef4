#include "claims/predicates.hpp"

#include "model/elementary.hpp"

#include <algorithm>
#include <cmath>

namespace bristle::claims {
namespace {

double relative_error(const CurvePoint& p) { return p.error / std::abs(p.value); }

// Sum of errors: in quadrature if they are independent, otherwise linear.
class ErrorSum {
 public:
  explicit ErrorSum(bool independent) : independent_(independent) {}
  void add(double error) { sum_ += independent_ ? error * error : std::abs(error); }
  double value() const { return independent_ ? std::sqrt(sum_) : sum_; }

 private:
  bool independent_;
  double sum_ = 0;
};

// Mean over the curves with at least two points. of_curve returns {value, uncertainty} of one curve.
template <class OfCurve>
Measurement mean_over(const Curves& in, OfCurve of_curve) {
  double sum = 0;
  ErrorSum uncertainty(in.independent);
  std::size_t used = 0;
  for (const Curve& curve : in.curves) {
    if (curve.size() < 2) continue;
    const auto [value, error] = of_curve(curve);
    sum += value;
    uncertainty.add(error);
    ++used;
  }
  Measurement out;
  out.missing = in.missing;
  out.curves = used;
  if (used == 0) return out;
  out.value = sum / double(used);
  out.uncertainty = uncertainty.value() / double(used);
  return out;
}

struct Estimate {
  double value, uncertainty;
};

// ln of the ratio of two values.
Estimate log_ratio(const CurvePoint& a, const CurvePoint& b) {
  return {log(a.value / b.value), relative_error(a) + relative_error(b)};
}

Measurement exponential(Measurement m) {
  m.value = exp(m.value);
  m.uncertainty *= m.value;
  return m;
}

Measurement mean_log_range(const Curves& in) {
  return mean_over(in, [](const Curve& curve) {
    const auto [low, high] = std::ranges::minmax_element(curve, {}, &CurvePoint::value);
    return Estimate{log(high->value / low->value), relative_error(*low) + relative_error(*high)};
  });
}

// Sign of a change; 0 if its size does not exceed its error.
int sign_of(double change, double error) { return change > error ? 1 : change < -error ? -1 : 0; }

// Pairs of points, counted for Kendall's tau.
struct Pairs {
  long rising = 0, falling = 0, all = 0;
  double variance = 0;  // of rising - falling if there is no association

  void add(int sign) {
    ++all;
    rising += sign > 0;
    falling += sign < 0;
  }
  void add_points(std::size_t count) {
    const auto n = double(count);
    variance += n * (n - 1) * (2 * n + 5) / 18;
  }
  Measurement measurement(std::size_t curves, std::size_t missing) const {
    Measurement out;
    out.curves = curves;
    out.missing = missing;
    if (all == 0) return out;
    const auto difference = double(rising - falling);
    out.value = difference / double(all);
    out.uncertainty = double(all - rising - falling) / double(all);
    out.significance = erfc(std::abs(difference) / std::sqrt(2 * variance));
    return out;
  }
};

// Slopes of ln(value) over ln(abscissa) between neighbouring points, with their errors.
std::vector<Estimate> log_slopes(const Curve& curve) {
  std::vector<Estimate> out;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const double run = log(curve[i].x / curve[i - 1].x);
    out.push_back({log(curve[i].value / curve[i - 1].value) / run,
                   (relative_error(curve[i]) + relative_error(curve[i - 1])) / std::abs(run)});
  }
  return out;
}

std::size_t steepest(const std::vector<Estimate>& slopes) {
  return std::size_t(std::ranges::min_element(slopes, {}, &Estimate::value) - slopes.begin());
}

// ln(abscissa) at which the curve first falls to a level after the point from, and half the distance of the
// points there.
Estimate falls_to(const Curve& curve, std::size_t from, double level) {
  for (std::size_t i = from + 1; i < curve.size(); ++i) {
    if (curve[i].value > level) continue;
    const double a = log(curve[i - 1].x), b = log(curve[i].x);
    const double share = (curve[i - 1].value - level) / (curve[i - 1].value - curve[i].value);
    return {a + share * (b - a), std::abs(b - a) / 2};
  }
  return {NAN, NAN};
}

}  // namespace

Measurement trend(const Curves& in) {
  Pairs pairs;
  std::size_t used = 0;
  for (const Curve& curve : in.curves) {
    if (curve.size() >= 2) ++used;
    pairs.add_points(curve.size());
    for (std::size_t i = 0; i < curve.size(); ++i)
      for (std::size_t j = i + 1; j < curve.size(); ++j)
        pairs.add(sign_of(curve[j].value - curve[i].value, curve[i].error + curve[j].error) *
                  sign_of(curve[j].x - curve[i].x, curve[i].x_error + curve[j].x_error));
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

Measurement rise(const Curves& in) {
  return mean_over(in, [](const Curve& curve) { return log_ratio(curve.back(), curve.front()); });
}

Measurement end_ratio(const Curves& in) { return exponential(rise(in)); }

Measurement top_ratio(const Curves& in) {
  return exponential(mean_over(in, [](const Curve& curve) {
    return log_ratio(*std::ranges::max_element(curve, {}, &CurvePoint::value), curve.front());
  }));
}

Measurement range_ratio(const Curves& along, const Curves& against) {
  Measurement a = mean_log_range(along);
  const Measurement b = mean_log_range(against);
  const double ratio = a.value / b.value;
  a.uncertainty = ratio * (a.uncertainty / a.value + b.uncertainty / b.value);
  a.value = ratio;
  a.curves += b.curves;
  return a;
}

Measurement slope(const Curves& in, bool logarithmic) {
  return mean_over(in, [logarithmic, &in](const Curve& curve) {
    const auto n = double(curve.size());
    const auto x_of = [=](const CurvePoint& p) { return logarithmic ? log(p.x) : p.x; };
    const auto y_of = [=](const CurvePoint& p) { return logarithmic ? log(p.value) : p.value; };
    double x_mean = 0, squares = 0, value = 0;
    ErrorSum uncertainty(in.independent);
    for (const CurvePoint& p : curve) x_mean += x_of(p) / n;
    for (const CurvePoint& p : curve) squares += (x_of(p) - x_mean) * (x_of(p) - x_mean);
    for (const CurvePoint& p : curve) value += (x_of(p) - x_mean) / squares * y_of(p);
    for (const CurvePoint& p : curve) {
      const double y_error = logarithmic ? relative_error(p) : p.error;
      const double x_error = logarithmic ? p.x_error / std::abs(p.x) : p.x_error;
      uncertainty.add((x_of(p) - x_mean) / squares * (y_error + std::abs(value) * x_error));
    }
    return Estimate{value, uncertainty.value()};
  });
}

Measurement plateau(const Curves& in) {
  return mean_over(in, [](const Curve& curve) {
    const auto [low, high] = std::ranges::minmax_element(curve, {}, &CurvePoint::value);
    double mean = 0;
    for (const CurvePoint& p : curve) mean += p.value / double(curve.size());
    return Estimate{(high->value - low->value) / mean, (high->error + low->error) / mean};
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
  out.uncertainty = uncertainty.value() / double(points);
  return out;
}

Measurement steepest_fall(const Curves& in) {
  return mean_over(in, [](const Curve& curve) {
    const auto slopes = log_slopes(curve);
    const std::size_t at = steepest(slopes);
    std::size_t from = at, to = at;
    for (std::size_t i = 0; i < slopes.size(); ++i)
      if (slopes[i].value - slopes[i].uncertainty <= slopes[at].value + slopes[at].uncertainty) {
        from = std::min(from, i);
        to = std::max(to, i);
      }
    const double place = std::sqrt(curve[at].x * curve[at + 1].x);
    return Estimate{place, std::max(place - curve[from].x, curve[to + 1].x - place)};
  });
}

Measurement steepness(const Curves& in) {
  return mean_over(in, [](const Curve& curve) {
    const auto slopes = log_slopes(curve);
    const Estimate& s = slopes[steepest(slopes)];
    return Estimate{-s.value, s.uncertainty};
  });
}

Measurement fall_width(const Curves& in) {
  return mean_over(in, [](const Curve& curve) {
    const auto high = std::ranges::max_element(curve, {}, &CurvePoint::value);
    const auto low = std::ranges::min_element(high, curve.end(), {}, &CurvePoint::value);
    const double range = high->value - low->value;
    const auto from = std::size_t(high - curve.begin());
    const Estimate begin = falls_to(curve, from, high->value - range / 4);
    const Estimate end = falls_to(curve, from, high->value - 3 * range / 4);
    return Estimate{end.value - begin.value, begin.uncertainty + end.uncertainty};
  });
}

Measurement fold(const Curves& in) {
  Measurement out;
  out.missing = in.missing;
  for (const Curve& curve : in.curves) {
    if (curve.size() < 2) continue;
    ++out.curves;
    CurvePoint top = curve.front();
    for (const CurvePoint& p : curve) {
      if (p.value > top.value) top = p;
      const double drop = (top.value - p.value) / top.value;
      if (drop <= out.value) continue;
      out.value = drop;
      out.uncertainty = (top.error + p.error) / top.value;
    }
    if (!(out.value >= 0)) out.value = out.uncertainty = 0;
  }
  return out;
}

Measurement ordering(const Curve& first, const Curve& second) {
  Pairs pairs;
  std::size_t missing = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (std::isfinite(first[i].value) && std::isfinite(second[i].value))
      pairs.add(sign_of(first[i].value - second[i].value, first[i].error + second[i].error));
    else ++missing;
  }
  Measurement out = pairs.measurement(2, missing);
  out.significance = NAN;  // of a rank correlation only
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
  out.uncertainty = resolved ? 1 / std::sqrt(2 * double(n)) : INFINITY;
  return out;
}

}  // namespace bristle::claims
