#include "simd/engine.hpp"

#include "dynamics/ode.hpp"
#include "dynamics/rules.hpp"

#include <algorithm>

namespace bristle {
namespace {

constexpr double kFractionTolerance = 1e-14;
// Near the axis a bristle oscillates about its place, and its means do not depend on the phase: its tolerance
// may be looser (docs/numerics.md has the measurement).
constexpr double kPinnedFactor = 30;
// A tip this close to s_min, relatively, is at the pole.
constexpr double kPoleTolerance = 1e-2;
constexpr long kEvaluationsPerStep = 6;
// The explicit method goes on once the tip is this much farther from the axis than where it stopped.
constexpr double kReturnFactor = 2;

constexpr double kNever = std::numeric_limits<double>::infinity();

// A passage under way.
struct Flight {
  PassageTask task;
  std::size_t ticket;
  OdeState y;
  double t = 0, h = kFirstStep, x_0 = 0;
  long steps = 0;
  int reflections = 0;
  std::vector<PathSample> samples{};
  bool implicit = false;  // the implicit method had a part in it
  bool slow = false;      // the explicit method took too many steps
};

long max_steps(const IntegratorOptions& options) { return options.max_evaluations / kEvaluationsPerStep; }

// Cubic through values p, q and slopes v, w at both ends of a step, as a function of its fraction u.
struct Hermite {
  Hermite(double p, double q, double v, double w)
      : p(p), v(v), b(3 * (q - p) - 2 * v - w), a(2 * (p - q) + v + w) {}
  double value(double u) const { return p + u * (v + u * (b + u * a)); }
  double slope(double u) const { return v + u * (2 * b + 3 * u * a); }
  double p, v, b, a;
};

// The tip's way in the plane along a step, as a function of its fraction u.
class Arc {
 public:
  Arc(const OdeState& from, const OdeState& to, double h) : from_(from), to_(to), h_(h) {}
  OdeState operator()(double u) const {
    OdeState at{};
    for (const int c : {X, Y}) {
      const Hermite cubic(from_[c], to_[c], h_ * from_[VX + c], h_ * to_[VX + c]);
      at[c] = cubic.value(u);
      at[VX + c] = cubic.slope(u) / h_;
    }
    return at;
  }

 private:
  const OdeState &from_, &to_;
  double h_;
};

}  // namespace

// The lanes of one method for one friction law and closure, and the passages that wait for one.
class LaneEngine::Set {
 public:
  Set(LaneEngine& engine, FrictionLaw friction, AzimuthRate rate, bool implicit)
      : engine_(engine), implicit_(implicit) {
    block_.friction = friction;
    block_.azimuth_rate = rate;
  }

  bool serves(const PassageTask& task, bool implicit) const {
    return implicit == implicit_ && task.bristle.friction == block_.friction &&
           task.bristle.azimuth_rate == block_.azimuth_rate;
  }
  int occupied() const { return __builtin_popcount(block_.occupied); }
  double tried() const { return double(block_.tried); }
  std::size_t load() const { return waiting_.size() + std::size_t(occupied()); }

  void add(Flight&& flight) { waiting_.push_back(std::move(flight)); }

  // Fills free lanes, steps until an event, answers it.
  void run() {
    for (int lane = 0; lane < kLanes && !waiting_.empty(); ++lane) {
      if (block_.occupied >> lane & 1) continue;
      put(lane, std::move(waiting_.front()));
      waiting_.pop_front();
    }
    const auto steps = implicit_ ? engine_.kernels_.implicit_steps : engine_.kernels_.explicit_steps;
    const Events events = steps(block_);
    for (int lane = 0; lane < kLanes; ++lane)
      if (events.any() >> lane & 1) answer(lane, events);
  }

 private:
  void put(int lane, Flight&& flight) {
    const PassageTask& task = flight.task;
    const double factor = implicit_ && !flight.slow ? kPinnedFactor : 1;
    const auto set = [lane](Row& row, double value) { row.lane[lane] = value; };
    int i = 0;
    for (const double* constant : constants_of(task.bristle)) set(block_.constants[i++], *constant);
    set(block_.rtol, factor * task.integrator.rtol);
    set(block_.atol, factor * task.integrator.atol);
    set(block_.L_x, task.parameters->L_x);
    set(block_.x_0, flight.x_0);
    set(block_.near_pole, method_border(flight));
    set(block_.pole, task.parameters->s_min);
    set(block_.attempts, 0);
    const double interval = task.sample_interval;
    set(block_.next_sample, interval > 0 ? double(flight.samples.size() + 1) * interval : kNever);
    long limit = max_steps(task.integrator) - flight.steps;
    if (!implicit_ && task.integrator.method == Method::automatic) limit = std::min(limit, kExplicitSteps);
    set(block_.max_attempts, double(limit));
    block_.occupied |= 1u << lane;
    flights_[lane] = std::move(flight);
    restart(lane);
  }

  // The distance from the axis at which the other method takes over.
  double method_border(const Flight& flight) const {
    const PassageTask& task = flight.task;
    const bool automatic = task.integrator.method == Method::automatic;
    const double stiff = kStiffRanges * task.parameters->lambda;
    if (!implicit_) return automatic ? stiff : task.parameters->s_min;
    return automatic && !flight.slow ? kReturnFactor * stiff : std::numeric_limits<double>::infinity();
  }

  // Hands the flight's time, step size and state to its lane.
  void restart(int lane) {
    const Flight& flight = flights_[lane];
    block_.t.lane[lane] = flight.t;
    block_.h.lane[lane] = flight.h;
    for (int c = 0; c < COMPONENTS; ++c) block_.y[c].lane[lane] = flight.y[c];
    block_.fresh |= 1u << lane;
  }

  void answer(int lane, const Events& events) {
    const auto has = [lane](std::uint32_t bits) { return (bits >> lane & 1) != 0; };
    Flight& flight = flights_[lane];
    for (int c = 0; c < COMPONENTS; ++c) flight.y[c] = block_.y[c].lane[lane];
    flight.t = block_.t.lane[lane];
    if (has(events.stuck)) return end(lane, Outcome::not_finite);
    if (has(events.axis) && !implicit_) return hand_over(lane);
    if (has(events.sample)) commit(lane);
    if (has(events.away)) return hand_over(lane);
    if (has(events.axis | events.exit)) {
      if (answer_step(lane, has(events.axis), has(events.exit))) return;
    }
    if (!has(events.exhausted)) return;
    const bool gives_up = flight.steps + attempts(lane) >= max_steps(flight.task.integrator);
    if (implicit_ || gives_up || flight.task.integrator.method != Method::automatic)
      return end(lane, Outcome::step_limit);
    flight.slow = true;
    hand_over(lane);
  }

  // A step in which the tip may meet the pole or reach its exit: accepts it if that is where it ends,
  // otherwise asks for a step that ends there. True if the passage is over.
  bool answer_step(int lane, bool axis, bool exit) {
    Flight& flight = flights_[lane];
    const double h = block_.t_new.lane[lane] - flight.t;
    OdeState y_new;
    for (int c = 0; c < COMPONENTS; ++c) y_new[c] = block_.y_new[c].lane[lane];
    const Arc arc(flight.y, y_new, h);
    const double L_x = flight.task.parameters->L_x, s_min = flight.task.parameters->s_min;
    double pole = kNever, exit_at = kNever;
    if (axis) pole = pole_contact(arc, s_min, 0, 1, kFractionTolerance);
    const bool ends_at_pole = std::abs(in_plane_distance(y_new) / s_min - 1) < kPoleTolerance;
    if (axis && pole > 0.5 && ends_at_pole) pole = 1;
    const auto slip = [&](double u) { return flight.t + u * h - (arc(u)[X] - flight.x_0) - L_x; };
    if (exit) exit_at = slip(1) <= kSlipTolerance ? 1 : first_root(slip, 0, 1, kFractionTolerance);
    const double first = std::min(pole, exit_at);
    if (first < 1) {
      if (first == pole && in_plane_distance(flight.y) <= s_min * (1 + kPoleTolerance)) {
        reflect_at(lane);
      } else {
        block_.h.lane[lane] = first * h;
      }
      return false;
    }
    accept(lane, y_new);
    if (exit_at == 1) {
      end(lane, Outcome::left);
      return true;
    }
    if (pole == 1) reflect_at(lane);
    return false;
  }

  // Accepts a step that the kernel left open for its samples.
  void commit(int lane) {
    Flight& flight = flights_[lane];
    sample(lane);
    block_.t.lane[lane] = flight.t = block_.t_new.lane[lane];
    block_.h.lane[lane] = block_.h_next.lane[lane];
    for (int c = 0; c < COMPONENTS; ++c) {
      block_.y[c].lane[lane] = flight.y[c] = block_.y_new[c].lane[lane];
      block_.slope[c].lane[lane] = block_.slope_new[c].lane[lane];
    }
  }

  // The integrals at the multiples of the interval within the open step, by cubics through its ends.
  void sample(int lane) {
    Flight& flight = flights_[lane];
    const double interval = flight.task.sample_interval, from = flight.t, h = block_.t_new.lane[lane] - from;
    if (interval == 0) return;
    double next = block_.next_sample.lane[lane];
    while (next <= from + h) {
      const auto at = [&](int c) {
        const Hermite cubic(block_.y[c].lane[lane], block_.y_new[c].lane[lane],
                            h * block_.slope[c].lane[lane], h * block_.slope_new[c].lane[lane]);
        return cubic.value((next - from) / h);
      };
      flight.samples.push_back({at(NORMAL), at(FRICTION_X), at(FRICTION_Y)});
      next = double(flight.samples.size() + 1) * interval;
    }
    block_.next_sample.lane[lane] = next;
  }

  void accept(int lane, const OdeState& y_new) {
    Flight& flight = flights_[lane];
    sample(lane);
    flight.y = y_new;
    flight.t = block_.t_new.lane[lane];
    flight.h = block_.h_next.lane[lane];
    restart(lane);
  }

  void reflect_at(int lane) {
    Flight& flight = flights_[lane];
    if (apply_pole_rule(flight.task.parameters->pole_rule, flight.y)) ++flight.reflections;
    flight.h = std::min(block_.h_next.lane[lane], kFirstStep);
    restart(lane);
  }

  long attempts(int lane) const { return long(block_.attempts.lane[lane]); }

  void release(int lane) {
    flights_[lane].steps += attempts(lane);
    engine_.useful_ += double(attempts(lane));
    block_.occupied &= ~(1u << lane);
  }

  void hand_over(int lane) {
    release(lane);
    Flight flight = std::move(flights_[lane]);
    flight.h = std::min(block_.h.lane[lane], kFirstStep);
    flight.implicit = true;
    engine_.set_for(flight.task, !implicit_).add(std::move(flight));
  }

  void end(int lane, Outcome outcome) {
    release(lane);
    const Flight& flight = flights_[lane];
    Passage out;
    out.outcome = outcome;
    out.theta_0 = flight.task.bristle.theta_0;
    out.contact_time = flight.t;
    out.end = flight.y;
    out.steps = flight.steps;
    out.evaluations = kEvaluationsPerStep * flight.steps;
    out.reflections = flight.reflections;
    out.implicit = flight.implicit;
    out.samples = std::move(flights_[lane].samples);
    if (out.complete()) evaluate_exit(flight.task, out);
    ++engine_.ended_;
    engine_.done_(flight.ticket, std::move(out));
  }

  LaneEngine& engine_;
  bool implicit_;
  Block block_{};
  std::array<Flight, kLanes> flights_;
  std::deque<Flight> waiting_;
};

LaneEngine::LaneEngine(const Kernels& kernels, Done done) : kernels_(kernels), done_(std::move(done)) {}
LaneEngine::~LaneEngine() = default;

LaneEngine::Set& LaneEngine::set_for(const PassageTask& task, bool implicit) {
  for (const auto& set : sets_)
    if (set->serves(task, implicit)) return *set;
  const Bristle<double>& b = task.bristle;
  sets_.push_back(std::make_unique<Set>(*this, b.friction, b.azimuth_rate, implicit));
  return *sets_.back();
}

void LaneEngine::submit(const PassageTask& task, std::size_t ticket) {
  Flight flight{task, ticket, pack(state_at_rest(task.bristle, task.start))};
  flight.x_0 = flight.y[X];
  flight.implicit = task.integrator.method == Method::implicit_only;
  set_for(task, flight.implicit).add(std::move(flight));
}

LaneEngine::Usage LaneEngine::usage() const {
  Usage usage;
  usage.useful = useful_;
  for (const auto& set : sets_) usage.made += set->tried();
  return usage;
}

bool LaneEngine::advance() {
  const auto lighter = [](const auto& a, const auto& b) {
    return std::min<std::size_t>(a->load(), kLanes) < std::min<std::size_t>(b->load(), kLanes);
  };
  ended_ = 0;
  while (ended_ == 0) {
    const auto busiest = std::max_element(sets_.begin(), sets_.end(), lighter);
    if (busiest == sets_.end() || (*busiest)->load() == 0) return false;
    (*busiest)->run();
  }
  return true;
}

}  // namespace bristle
