#pragma once

#include "dynamics/ode.hpp"
#include "simd/block.hpp"
#include "simd/lanes.hpp"

namespace bristle::HWY_NAMESPACE {

// The part of a Block that fits into one Lanes, during an attempted step.
struct Group {
  Bristle<Lanes> bristle;
  Lanes rtol, atol, s_handover, s_min;
  Lanes h;
  std::array<Lanes, COMPONENTS> y, slope, y_new, slope_new;
};

inline Lanes in_plane_distance_squared(const std::array<Lanes, COMPONENTS>& y) {
  return y[X] * y[X] + y[Y] * y[Y];
}
inline Lanes radial_product(const std::array<Lanes, COMPONENTS>& y) { return y[X] * y[VX] + y[Y] * y[VY]; }

// Slopes of all components from the first kState components. One copy for all stages of both methods: inlined
// copies would not fit the instruction cache.
HWY_NOINLINE HWY_FLATTEN inline void evaluate(const Bristle<Lanes>& b, const Lanes* y,
                                              std::array<Lanes, COMPONENTS>& slope) {
  derivative<Lanes>(b, y, slope);
}

template <int Stages, int Components = COMPONENTS>
using Slopes = std::array<std::array<Lanes, Components>, Stages>;

// sum_j weight(j) k_j over the first Count slopes of a component; weight is a constant expression.
template <int Count, class AllSlopes, class Weight, std::size_t... J>
HWY_INLINE Lanes weighted_sum(const AllSlopes& k, int component, Weight weight, std::index_sequence<J...>) {
  Lanes sum = k[0][component] * Lanes(weight(0));
  const auto add = [&](auto j) {
    if constexpr (j > 0 && Weight{}(j) != 0) sum += k[j][component] * Lanes(Weight{}(j));
  };
  (add(std::integral_constant<int, int(J)>{}), ...);
  return sum;
}
template <int Count, class AllSlopes, class Weight>
HWY_INLINE Lanes weighted_sum(const AllSlopes& k, int component, Weight weight) {
  return weighted_sum<Count>(k, component, weight, std::make_index_sequence<Count>());
}

// The largest ratio of error to tolerance; NaN if any error is NaN. Ratios are compared by
// cross-multiplication, so that there is only one division.
class ErrorNorm {
 public:
  explicit ErrorNorm(const Group& g) : g_(g) {}
  void add(int component, const Lanes& error) {
    const Lanes size = abs(error);
    const Lanes allowed = g_.atol + g_.rtol * abs(g_.y[component]);
    const Lanes::Mask is_larger = Lanes(largest_ * allowed) < Lanes(size * allowed_);
    largest_ = select(is_larger, size, largest_);
    allowed_ = select(is_larger, allowed, allowed_);
    sum_ += size;
  }
  Lanes value() const { return largest_ / allowed_ + (sum_ - sum_); }

 private:
  const Group& g_;
  Lanes largest_ = 0.0, allowed_ = 1.0, sum_ = 0.0;
};

// The step size that would have met the tolerance, times a
// safety factor of 0.9, limited to a change by a factor of 5.
inline Lanes next_size(const Lanes& h, const Lanes& error, double exponent) {
  const Lanes factor = Lanes::make([&](int i) {
    const auto e = hn::Max(error.v[i], hn::Set(Lanes::tag, 1e-5));
    return hn::Exp(Lanes::tag, hn::Mul(hn::Set(Lanes::tag, exponent), hn::Log(Lanes::tag, e)));
  });
  const Lanes wanted = min(max(0.9 * factor, 0.2), 5.0);
  return h * select(error < 1e6, wanted, 0.2);  // a NaN error is not less than 1e6
}

// Attempts steps of all lanes until one of them has an event.
template <class Step>
class Kernel {
 public:
  static Events run(Block& block) {
    Events events;
    while (events.any() == 0)
      for (int first = 0; first < kLanes; first += Lanes::kSize) {
        constexpr std::uint32_t all = (1u << Lanes::kSize) - 1;
        if ((block.occupied >> first) & all) {
          step(block, first, events);
          block.lane_steps += Lanes::kSize;
        }
      }
    return events;
  }

 private:
  static void step(Block& block, int first, Events& events) {
    Group g;
    load(block, first, g);
    const auto row = [first](Row& r) { return r.lane + first; };
    if ((block.stale_slope >> first) & ((1u << Lanes::kSize) - 1)) {
      Step::refresh(g);
      for (int c = 0; c < COMPONENTS; ++c) g.slope[c].store(row(block.slope[c]));
      block.stale_slope &= ~(((1u << Lanes::kSize) - 1) << first);
    }
    const Lanes error = Step::attempt(g);
    const Lanes t_new = Lanes::load(row(block.t)) + g.h;
    const Lanes h_next = next_size(g.h, error, Step::kExponent);
    const Lanes attempts = Lanes::load(row(block.attempts)) + 1.0;
    attempts.store(row(block.attempts));

    const Lanes::Mask good = error < 1.0;
    const Lanes slip = t_new - (g.y_new[X] - Lanes::load(row(block.x_0)));
    const Lanes::Mask exits = good & (slip >= Lanes::load(row(block.L_x)) - kSlipTolerance);
    const Lanes::Mask meets_pole = good & Step::pole_event(g);
    const Lanes::Mask ordinary = good & !(exits | meets_pole);
    const Lanes::Mask samples = ordinary & (t_new >= Lanes::load(row(block.next_sample)));
    const Lanes::Mask accepted = ordinary & !samples;
    const Lanes::Mask failed = (!good) & (h_next < kSmallestStep);
    const Lanes::Mask leaves_pole = ordinary & Step::leaves_pole(g);
    const Lanes::Mask exhausted = attempts >= Lanes::load(row(block.max_attempts));

    select(accepted, t_new, Lanes::load(row(block.t))).store(row(block.t));
    select(accepted | !good, h_next, g.h).store(row(block.h));
    for (int c = 0; c < COMPONENTS; ++c) {
      select(accepted, g.y_new[c], g.y[c]).store(row(block.y[c]));
      select(accepted, g.slope_new[c], g.slope[c]).store(row(block.slope[c]));
    }
    const auto bits = [&](const Lanes::Mask& m) { return (m.bits() << first) & block.occupied; };
    const std::uint32_t any = bits(exits | meets_pole | samples | leaves_pole | failed | exhausted);
    if (any == 0) return;
    events.exit |= bits(exits);
    events.pole |= bits(meets_pole);
    events.sample |= bits(samples);
    events.pole_left |= bits(leaves_pole);
    events.failed |= bits(failed);
    events.exhausted |= bits(exhausted);
    t_new.store(row(block.t_new));
    h_next.store(row(block.h_next));
    for (int c = 0; c < COMPONENTS; ++c) {
      g.y_new[c].store(row(block.y_new[c]));
      g.slope_new[c].store(row(block.slope_new[c]));
    }
  }

  static void load(const Block& block, int first, Group& g) {
    const auto row = [first](const Row& r) { return Lanes::load(r.lane + first); };
    g.bristle.friction = block.friction;
    g.bristle.azimuth_rate = block.azimuth_rate;
    int i = 0;
    for (Lanes* constant : constants_of(g.bristle)) *constant = row(block.constants[i++]);
    g.rtol = row(block.rtol);
    g.atol = row(block.atol);
    g.s_handover = row(block.s_handover);
    g.s_min = row(block.s_min);
    g.h = row(block.h);
    for (int c = 0; c < COMPONENTS; ++c) {
      g.y[c] = row(block.y[c]);
      g.slope[c] = row(block.slope[c]);
    }
  }
};

}  // namespace bristle::HWY_NAMESPACE
