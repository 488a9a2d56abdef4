#pragma once

#include "bristle/dynamics/ode.hpp"
#include "bristle/simd/block.hpp"
#include "bristle/simd/lanes.hpp"

namespace bristle::HWY_NAMESPACE {

constexpr int kVectors = kLanes / Lanes::kWidth;

// The part of a Block that fits into one Lanes.
struct Group {
  Bristle<Lanes> bristle;
  const ModulationTable* modulation;
  Lanes rtol, atol, L_x, x_0, s_handover, s_min, next_sample, max_attempts;
  Lanes attempts, t, h, last_error;
  std::array<Lanes, COMPONENTS> y;
  Path<Lanes> path;
  // Results of an attempt; error is the largest ratio of error to tolerance.
  std::array<Lanes, COMPONENTS> y_new;
  Path<Lanes> path_new;
  Lanes error;
};

inline Lanes in_plane_distance_squared(const std::array<Lanes, COMPONENTS>& y) {
  using namespace component;
  return y[X] * y[X] + y[Y] * y[Y];
}
inline Lanes radial_product(const std::array<Lanes, COMPONENTS>& y) {
  using namespace component;
  return y[X] * y[VX] + y[Y] * y[VY];
}

template <int Stages, int Components = COMPONENTS>
using Slopes = std::array<std::array<Lanes, Components>, Stages>;

// Returns sum_j weight(j) k_j over the first Count slopes of a component; weight is a constant expression.
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
    const Lanes allowed = g_.atol * Lanes(tolerance_scale(component)) + g_.rtol * abs(g_.y[component]);
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

// Returns x^exponent for x > 0, within 3 % for exponents between -1/3 and 1/3: the bits of a number, read as
// an integer, are nearly proportional to its logarithm.
inline Lanes rough_power(Lanes x, double exponent) {
  const hn::RebindToSigned<Lanes::D> integers;
  const Lanes bits_of_one = 4607182418800017408.0;
  const Lanes logarithm = Lanes(hn::ConvertTo(Lanes::tag, hn::BitCast(integers, x.v))) - bits_of_one;
  const Lanes power = logarithm * Lanes(exponent) + bits_of_one;
  return hn::BitCast(Lanes::tag, hn::ConvertTo(integers, power.v));
}

// Returns the size of the next step after a step of size h with this error, by the controller of K.
// Gustafsson, ACM Trans. Math. Softw. 17 (1991) 533: after an accepted step it takes the error of the
// accepted step before into account. Changes the size by a factor of 5 at most. exponent is -1/(order of the
// error).
inline Lanes next_size(Lanes h, Lanes error, Lanes last_error, double exponent) {
  const auto power = [](Lanes x, double e) { return rough_power(max(x, 1e-4), e); };
  const Lanes after_accepted = power(error, 0.7 * exponent) * power(last_error, -0.4 * exponent);
  const Lanes factor = 0.9 * select(error < 1.0, after_accepted, power(error, exponent));
  const Lanes limited = min(max(factor, 0.2), 5.0);
  return h * select(error < 1e6, limited, 0.2);  // a NaN error is not less than 1e6
}

// Attempts steps of all lanes until one of them has an event, by a Step for the Region, which tells which
// steps are events because of the pole. The processor overlaps the computations of different vectors, as
// their stages alternate.
template <class Step, class Region>
class Kernel {
 public:
  static Events run(Block& block) {
    alignas(64) static thread_local Group groups[kVectors];
    Events events;
    int used[kVectors], count = 0;
    for (int i = 0; i < kVectors; ++i)
      if ((block.occupied >> (i * Lanes::kWidth)) & ((1u << Lanes::kWidth) - 1)) {
        load(block, i * Lanes::kWidth, groups[count]);
        used[count++] = i * Lanes::kWidth;
      }
    while (events.any() == 0) {
      Step::attempt(groups, count);
      for (int i = 0; i < count; ++i) control(block, used[i], groups[i], events);
      block.lane_steps += std::uint64_t(count) * Lanes::kWidth;
    }
    for (int i = 0; i < count; ++i) {
      const auto row = [first = used[i]](Row& r) { return r.lane + first; };
      groups[i].t.store(row(block.t));
      groups[i].h.store(row(block.h));
      groups[i].last_error.store(row(block.last_error));
      groups[i].attempts.store(row(block.attempts));
      for (int c = 0; c < COMPONENTS; ++c) groups[i].y[c].store(row(block.y[c]));
      for (int c = 0; c < PATH_QUANTITIES; ++c) groups[i].path[c].store(row(block.path[c]));
    }
    return events;
  }

 private:
  static void control(Block& block, int first, Group& g, Events& events) {
    const auto row = [first](Row& r) { return r.lane + first; };
    const Lanes t_new = g.t + g.h;
    const Lanes h_next = next_size(g.h, g.error, g.last_error, Step::kExponent);
    g.attempts += Lanes(1.0);

    const Lanes::Mask good = g.error < 1.0;
    const Lanes slip = t_new - (g.y_new[component::X] - g.x_0);
    const Lanes::Mask exits = good & (slip >= g.L_x - kSlipTolerance);
    const Lanes::Mask meets_pole = good & Region::pole_event(g);
    const Lanes::Mask ordinary = good & !(exits | meets_pole);
    const Lanes::Mask samples = ordinary & (t_new >= g.next_sample);
    const Lanes::Mask accepted = ordinary & !samples;
    const Lanes::Mask failed = (!good) & (h_next < kSmallestStep);
    const Lanes::Mask leaves_pole = ordinary & Region::leaves_pole(g);
    const Lanes::Mask exhausted = g.attempts >= g.max_attempts;

    const auto bits = [&](Lanes::Mask m) { return (m.bits() << first) & block.occupied; };
    if (bits(exits | meets_pole | samples | leaves_pole | failed | exhausted) != 0) {
      events.exit |= bits(exits);
      events.pole |= bits(meets_pole);
      events.sample |= bits(samples);
      events.pole_left |= bits(leaves_pole);
      events.failed |= bits(failed);
      events.exhausted |= bits(exhausted);
      t_new.store(row(block.t_new));
      h_next.store(row(block.h_next));
      g.error.store(row(block.error));
      for (int c = 0; c < COMPONENTS; ++c) g.y_new[c].store(row(block.y_new[c]));
      for (int c = 0; c < PATH_QUANTITIES; ++c) g.path_new[c].store(row(block.path_new[c]));
    }
    g.t = select(accepted, t_new, g.t);
    g.h = select(accepted | !good, h_next, g.h);
    g.last_error = select(accepted, g.error, g.last_error);
    for (int c = 0; c < COMPONENTS; ++c) g.y[c] = select(accepted, g.y_new[c], g.y[c]);
    for (int c = 0; c < PATH_QUANTITIES; ++c) g.path[c] = select(accepted, g.path_new[c], g.path[c]);
  }

  static void load(const Block& block, int first, Group& g) {
    const auto row = [first](const Row& r) { return Lanes::load(r.lane + first); };
    g.bristle.friction = block.friction;
    g.bristle.bending = block.bending;
    g.bristle.contact = block.contact;
    g.modulation = block.modulation;
    int i = 0;
    for (Lanes* constant : constants_of(g.bristle)) *constant = row(block.constants[i++]);
    g.rtol = row(block.rtol);
    g.atol = row(block.atol);
    g.L_x = row(block.L_x);
    g.x_0 = row(block.x_0);
    g.s_handover = row(block.s_handover);
    g.s_min = row(block.s_min);
    g.next_sample = row(block.next_sample);
    g.max_attempts = row(block.max_attempts);
    g.attempts = row(block.attempts);
    g.t = row(block.t);
    g.h = row(block.h);
    g.last_error = row(block.last_error);
    for (int c = 0; c < COMPONENTS; ++c) g.y[c] = row(block.y[c]);
    for (int c = 0; c < PATH_QUANTITIES; ++c) g.path[c] = row(block.path[c]);
  }
};

}  // namespace bristle::HWY_NAMESPACE
