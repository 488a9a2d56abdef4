#include "ensemble/load.hpp"

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/roots.hpp>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace bristle {
namespace {

struct CannotCompute {};

// A gap on the path: excess < 0 before the target is met.
struct Stop {
  double z_0;
  Load load;
  double excess;
};

class Path {
 public:
  Path(const LoadCurve& curve, const LoadSearch& search) : curve_(curve), search_(search) {}

  LoadPoint walk() {
    LoadPoint out;
    try {
      if (!find_bracket(out)) return out;
      locate(out);
    } catch (const CannotCompute&) {
      out.status = LoadStatus::failed;
    }
    return out;
  }

 private:
  Stop at(double z_0, Accuracy accuracy) {
    const Load load = curve_(z_0, accuracy);
    if (!std::isfinite(load.R_n)) throw CannotCompute{};
    const double sign = search_.path == LoadPath::loading ? 1 : -1;
    return {z_0, load, sign * (load.R_n - search_.target)};
  }

  std::vector<double> scan() const {
    const double length = search_.first_contact - search_.ground;
    const int count = std::max(2, int(std::ceil(length / search_.step)));
    std::vector<double> gaps;
    for (int i = 0; i <= count; ++i) gaps.push_back(search_.first_contact - length * i / count);
    if (search_.path == LoadPath::unloading) std::reverse(gaps.begin(), gaps.end());
    return gaps;
  }

  // The first neighbouring stops with excess < 0 before and >= 0 behind. What rough means find is confirmed.
  bool find_bracket(LoadPoint& out) {
    std::vector<Stop> stops;
    for (double z_0 : scan()) {
      stops.push_back(at(z_0, Accuracy::rough));
      const std::size_t n = stops.size();
      if (n >= 3)
        if (const auto peak = hump(stops[n - 3], stops[n - 2], stops[n - 1])) {
          stops.resize(n - 2);
          return bracket_before(out, *peak, stops);
        }
      if (stops.back().excess < 0) continue;
      stops.back() = at(z_0, Accuracy::precise);
      if (stops.back().excess < 0) continue;
      const Stop far = stops.back();
      stops.pop_back();
      return bracket_before(out, far, stops);
    }
    return false;
  }

  // The last of the stops that does not meet the target, by precise means, and the one behind it.
  bool bracket_before(LoadPoint& out, Stop far, const std::vector<Stop>& stops) {
    for (auto stop = stops.rbegin(); stop != stops.rend(); ++stop) {
      const Stop near = at(stop->z_0, Accuracy::precise);
      if (near.excess < 0) return set_bracket(out, near, far);
      far = near;
    }
    if (search_.path == LoadPath::unloading) return false;  // carries less than the target already
    return set_bracket(out, above_contact(), far);
  }

  // The wall is soft: a load below R_n(sin(phi_0)) is met a few of its ranges above.
  Stop above_contact() {
    Stop stop = at(search_.first_contact, Accuracy::precise);
    double lift = 1e-3;
    while (stop.excess >= 0 && lift < 0.1) {
      stop = at(search_.first_contact + lift, Accuracy::precise);
      lift *= 2;
    }
    return stop;
  }

  // A stop between a and c that meets the target, if b is the top of a hump that comes near it: one
  // whose parabola reaches to within 5 % of the target is searched.
  std::optional<Stop> hump(const Stop& a, const Stop& b, const Stop& c) {
    if (!(b.excess < 0 && c.excess < 0 && b.excess >= a.excess && b.excess >= c.excess)) return {};
    const double rise = b.excess - a.excess, fall = b.excess - c.excess;
    const double peak = b.excess + (rise - fall) * (rise - fall) / (8 * (rise + fall) + 1e-300);
    if (peak + b.load.error < -0.05 * search_.target) return {};
    std::optional<Stop> found;
    const auto below = [&](double z_0) {
      if (found) return -found->excess;  // enough: ends the search quickly
      Stop stop = at(z_0, Accuracy::rough);
      if (stop.excess >= 0) stop = at(z_0, Accuracy::precise);
      if (stop.excess >= 0) found = stop;
      return -stop.excess;
    };
    std::uintmax_t iterations = 12;
    const auto [low, high] = std::minmax(a.z_0, c.z_0);
    boost::math::tools::brent_find_minima(below, low, high, 12, iterations);
    return found;
  }

  static bool set_bracket(LoadPoint& out, const Stop& near, const Stop& far) {
    out.z_0_near = near.z_0;
    out.z_0_far = far.z_0;
    return near.excess < 0;
  }

  void locate(LoadPoint& out) {
    Stop near = at(out.z_0_near, Accuracy::precise), far = at(out.z_0_far, Accuracy::precise);
    const double enough = search_.rtol * search_.target;
    std::optional<Stop> met;
    const auto excess = [&](double z_0) {
      const Stop stop = at(z_0, Accuracy::precise);
      (stop.excess < 0 ? near : far) = stop;
      if (std::abs(stop.excess) > enough) return stop.excess;
      met = stop;
      return 0.0;
    };
    if (std::abs(far.excess) <= enough) {
      met = far;
    } else {
      const bool descending = near.z_0 > far.z_0;
      const Stop &low = descending ? far : near, &high = descending ? near : far;
      const double a = low.z_0, b = high.z_0, f_a = low.excess, f_b = high.excess;
      const auto close = [&](double l, double r) { return r - l <= search_.z_0_resolution; };
      std::uintmax_t iterations = 60;
      boost::math::tools::toms748_solve(excess, a, b, f_a, f_b, close, iterations);
    }
    settle(out, near, far, met);
  }

  void settle(LoadPoint& out, const Stop& near, const Stop& far, const std::optional<Stop>& met) {
    const Stop& final = met ? *met : far;
    out.z_0 = final.z_0;
    out.load = final.load;
    const double noise = near.load.error + far.load.error;
    const bool at_target = met || far.excess <= 2 * far.load.error;
    const bool jumps = !at_target && far.excess - near.excess > 2 * noise;
    out.status = jumps ? LoadStatus::load_jump : LoadStatus::reached;
    if (jumps) {
      out.jump_z_0 = near.z_0;
      out.jump_R_n = near.load.R_n;
    }
  }

  const LoadCurve& curve_;
  const LoadSearch& search_;
};

}  // namespace

LoadPoint first_crossing(const LoadCurve& curve, const LoadSearch& search) {
  return Path(curve, search).walk();
}

}  // namespace bristle
