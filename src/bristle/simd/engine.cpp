#include "bristle/simd/engine.hpp"

#include "bristle/dynamics/ode.hpp"
#include "bristle/dynamics/rules.hpp"
#include "bristle/simd/hermite.hpp"

#include <algorithm>

namespace bristle {
namespace {

constexpr double kFractionTolerance = 1e-14;
// Near the pole a bristle oscillates about its equilibrium. Its means do not depend on the phase, so a looser
// tolerance suffices (measured in docs/numerics.md).
constexpr double kPinnedToleranceFactor = 3;
// A tip whose distance from the pole is this close to s_min, relatively, is at s_min.
constexpr double kPoleTolerance = 1e-4;
constexpr long kEvaluationsPerStep = 6;
// A passage leaves the neighbourhood of the pole at this multiple of the distance at which it entered.
constexpr double kReturnFactor = 2;

// Number of lane sets above which the lane sets without passages are removed.
constexpr std::size_t kMaxIdleSets = 16;

constexpr double kNever = std::numeric_limits<double>::infinity();

// A passage that has been submitted and has not ended.
struct ActivePassage {
  PassageTask task;
  std::size_t ticket;
  OdeState y;
  Path<double> path{};
  double t = 0, h = kFirstStep, x_0 = 0;
  long steps = 0;
  int reflections = 0;
  std::vector<PathSample> samples{};
  bool near_pole = false;  // it came near the pole
};

long max_steps(const IntegratorOptions& options) { return options.max_evaluations / kEvaluationsPerStep; }

}  // namespace

// The lanes for one friction law with its parameters, one Bending and one Contact, near the pole, or far from
// it or without one, and the queue of passages for them.
class SimdEngine::LaneSet {
 public:
  LaneSet(SimdEngine& engine, const PassageTask& task, std::shared_ptr<const ModulationTable> modulation,
          bool near_pole)
      : engine_(engine), modulation_(std::move(modulation)), near_pole_(near_pole) {
    block_.friction = task.bristle.friction;
    block_.bending = task.bristle.bending;
    block_.contact = task.bristle.contact;
    block_.modulation = modulation_.get();
  }

  bool serves(const PassageTask& task, bool near_pole) const {
    return near_pole == near_pole_ && task.bristle.bending == block_.bending &&
           task.bristle.contact == block_.contact && has_modulation_of(task);
  }
  bool has_modulation_of(const PassageTask& task) const {
    return modulation_->serves(task.bristle.friction, task.bristle.friction_constants);
  }
  const std::shared_ptr<const ModulationTable>& modulation() const { return modulation_; }
  int occupied() const { return __builtin_popcount(block_.occupied); }
  double lane_steps() const { return double(block_.lane_steps); }
  // Returns the number of passages in lanes and in the queue.
  std::size_t demand() const { return waiting_.size() + std::size_t(occupied()); }

  void add(ActivePassage&& active) { waiting_.push_back(std::move(active)); }

  // Fills empty lanes, steps until an event, handles it.
  void run() {
    for (int lane = 0; lane < kLanes && !waiting_.empty(); ++lane) {
      if (block_.occupied >> lane & 1) continue;
      start(lane, std::move(waiting_.front()));
      waiting_.pop_front();
    }
    const Events events = kernel()(block_);
    for (int lane = 0; lane < kLanes; ++lane)
      if (events.any() >> lane & 1) handle_events(lane, events);
  }

 private:
  Events (*kernel() const)(Block&) {
    const Kernels& kernels = engine_.kernels_;
    if (!has_pole(block_.bending)) return kernels.rod_steps;
    return near_pole_ ? kernels.near_steps : kernels.far_steps;
  }

  void start(int lane, ActivePassage&& active) {
    const PassageTask& task = active.task;
    const double factor = near_pole_ ? kPinnedToleranceFactor : 1;
    const auto set = [lane](Row& row, double value) { row.lane[lane] = value; };
    int i = 0;
    for (const double* constant : constants_of(task.bristle)) set(block_.constants[i++], *constant);
    set(block_.rtol, factor * task.integrator.rtol);
    set(block_.atol, factor * task.integrator.atol);
    set(block_.L_x, task.parameters->L_x);
    set(block_.x_0, active.x_0);
    set(block_.s_handover, handover_distance(active));
    set(block_.s_min, task.parameters->s_min);
    set(block_.attempts, 0);
    const double interval = task.sample_interval;
    set(block_.next_sample, interval > 0 ? double(active.samples.size() + 1) * interval : kNever);
    set(block_.max_attempts, double(max_steps(task.integrator) - active.steps));
    block_.occupied |= 1u << lane;
    active_[lane] = std::move(active);
    restart(lane);
  }

  // Returns the distance from the pole at which the other lane set takes over.
  double handover_distance(const ActivePassage& active) const {
    const PassageTask& task = active.task;
    const bool automatic = task.integrator.method == Method::automatic;
    // The lanes far from the pole do not test for s_min, so they end well before it, too.
    const double near = kStiffRanges * std::max(task.parameters->lambda, task.parameters->s_min);
    if (!near_pole_) return automatic ? near : task.parameters->s_min;
    return automatic ? kReturnFactor * near : std::numeric_limits<double>::infinity();
  }

  // Copies time, step size and state of the passage to its lane.
  void restart(int lane) {
    const ActivePassage& active = active_[lane];
    block_.t.lane[lane] = active.t;
    block_.h.lane[lane] = active.h;
    block_.last_error.lane[lane] = 1;
    for (int c = 0; c < COMPONENTS; ++c) block_.y[c].lane[lane] = active.y[c];
    for (int c = 0; c < PATH_QUANTITIES; ++c) block_.path[c].lane[lane] = active.path[c];
  }

  void handle_events(int lane, const Events& events) {
    const auto has = [lane](std::uint32_t bits) { return (bits >> lane & 1) != 0; };
    ActivePassage& active = active_[lane];
    for (int c = 0; c < COMPONENTS; ++c) active.y[c] = block_.y[c].lane[lane];
    for (int c = 0; c < PATH_QUANTITIES; ++c) active.path[c] = block_.path[c].lane[lane];
    active.t = block_.t.lane[lane];
    if (has(events.failed)) return end(lane, Outcome::not_finite);
    if (has(events.pole) && has_pole(block_.bending) && !near_pole_) return hand_over(lane);
    if (has(events.sample)) accept_sampled_step(lane);
    if (has(events.pole_left)) return hand_over(lane);
    if (has(events.pole | events.exit)) {
      if (resolve_pole_or_exit(lane, has(events.pole), has(events.exit))) return;
    }
    if (has(events.exhausted)) end(lane, Outcome::step_limit);
  }

  // Handles a step in which the tip may reach s_min or the exit. If the tip does so within the step, reduces
  // the step size so that the next attempt ends there; otherwise accepts the step. Applies the pole rule to a
  // tip at s_min. Returns true if the passage has ended.
  bool resolve_pole_or_exit(int lane, bool may_reach_pole, bool may_exit) {
    ActivePassage& active = active_[lane];
    const double h = block_.t_new.lane[lane] - active.t;
    OdeState y_new;
    for (int c = 0; c < COMPONENTS; ++c) y_new[c] = block_.y_new[c].lane[lane];
    const TipPath path(active.y, y_new, h);
    const Parameters& p = *active.task.parameters;
    const double L_x = p.L_x, s_min = p.s_min;
    double pole = kNever, exit_at = kNever;
    if (may_reach_pole) pole = pole_contact(path, p, 0, 1, kFractionTolerance);
    const bool ends_at_pole = std::abs(singular_distance(p.bending, y_new) / s_min - 1) < kPoleTolerance;
    if (may_reach_pole && pole > 0.5 && ends_at_pole) pole = 1;
    const Hermite x = path.coordinate(component::X);
    const auto slip = [&](double u) { return active.t + u * h - (x.value(u) - active.x_0) - L_x; };
    if (may_exit) exit_at = slip(1) <= kSlipTolerance ? 1 : first_root(slip, 0, 1, kFractionTolerance);
    const double first = std::min(pole, exit_at);
    if (first < 1) {
      if (first == pole && singular_distance(p.bending, active.y) <= s_min * (1 + kPoleTolerance)) {
        apply_pole_rule_in(lane);
      } else {
        block_.h.lane[lane] = first * h;
      }
      return false;
    }
    accept_step(lane, y_new);
    if (exit_at == 1) {
      end(lane, Outcome::left);
      return true;
    }
    if (pole == 1) apply_pole_rule_in(lane);
    return false;
  }

  // Accepts a step that the kernel did not accept because it contains samples.
  void accept_sampled_step(int lane) {
    ActivePassage& active = active_[lane];
    sample(lane);
    block_.t.lane[lane] = active.t = block_.t_new.lane[lane];
    block_.h.lane[lane] = block_.h_next.lane[lane];
    block_.last_error.lane[lane] = block_.error.lane[lane];
    for (int c = 0; c < COMPONENTS; ++c) block_.y[c].lane[lane] = active.y[c] = block_.y_new[c].lane[lane];
    for (int c = 0; c < PATH_QUANTITIES; ++c)
      block_.path[c].lane[lane] = active.path[c] = block_.path_new[c].lane[lane];
  }

  // Appends the samples within the step that is being accepted, by cubics through its ends.
  void sample(int lane) {
    ActivePassage& active = active_[lane];
    const double interval = active.task.sample_interval, from = active.t, h = block_.t_new.lane[lane] - from;
    double next = block_.next_sample.lane[lane];
    if (interval == 0 || next > from + h) return;
    OdeState y_new;
    for (int c = 0; c < COMPONENTS; ++c) y_new[c] = block_.y_new[c].lane[lane];
    const SlabForces before = slab_forces(active.task.bristle, active.y),
                     after = slab_forces(active.task.bristle, y_new);
    while (next <= from + h) {
      const auto at = [&](int c, double slope, double slope_new) {
        return Hermite(active.y[c], y_new[c], h * slope, h * slope_new).value((next - from) / h);
      };
      active.samples.push_back({at(component::NORMAL, before.normal, after.normal),
                                at(component::FRICTION_X, before.friction[0], after.friction[0]),
                                at(component::FRICTION_Y, before.friction[1], after.friction[1])});
      next = double(active.samples.size() + 1) * interval;
    }
    block_.next_sample.lane[lane] = next;
  }

  struct SlabForces {
    double normal;
    InPlane<double> friction;
  };
  // Returns the forces on the tip, with the modulation that the kernels use.
  SlabForces slab_forces(const Bristle<double>& b, const OdeState& y) const {
    const ContactForce<double> contact = contact_force(b, y[component::Z]);
    Sliding<double> sliding = relative_motion(y[component::VX], y[component::VY]);
    sliding.modulation = modulation_->at(sliding.V_R / b.V_scale);
    return {contact.F_n, friction_force(friction_limit(b, contact), sliding)};
  }

  void accept_step(int lane, const OdeState& y_new) {
    ActivePassage& active = active_[lane];
    sample(lane);
    active.y = y_new;
    for (int c = 0; c < PATH_QUANTITIES; ++c) active.path[c] = block_.path_new[c].lane[lane];
    active.t = block_.t_new.lane[lane];
    active.h = block_.h_next.lane[lane];
    restart(lane);
  }

  void apply_pole_rule_in(int lane) {
    ActivePassage& active = active_[lane];
    if (apply_pole_rule(*active.task.parameters, active.y)) ++active.reflections;
    active.h = std::min(block_.h_next.lane[lane], kFirstStep);
    restart(lane);
  }

  long attempts(int lane) const { return long(block_.attempts.lane[lane]); }

  void release(int lane) {
    active_[lane].steps += attempts(lane);
    engine_.passage_steps_ += double(attempts(lane));
    block_.occupied &= ~(1u << lane);
  }

  void hand_over(int lane) {
    release(lane);
    ActivePassage active = std::move(active_[lane]);
    active.h = block_.h.lane[lane];
    active.near_pole = true;
    engine_.lane_set_for(active.task, !near_pole_).add(std::move(active));
  }

  void end(int lane, Outcome outcome) {
    release(lane);
    const ActivePassage& active = active_[lane];
    Passage out;
    out.outcome = outcome;
    out.theta_0 = active.task.bristle.theta_0;
    out.contact_time = active.t;
    out.end = active.y;
    out.path = active.path;
    out.steps = active.steps;
    out.evaluations = kEvaluationsPerStep * active.steps;
    out.reflections = active.reflections;
    out.implicit = active.near_pole;
    out.samples = std::move(active_[lane].samples);
    if (out.complete()) evaluate_exit(active.task, out);
    ++engine_.ended_;
    engine_.done_(active.ticket, std::move(out));
  }

  SimdEngine& engine_;
  std::shared_ptr<const ModulationTable> modulation_;
  bool near_pole_;
  Block block_{};
  std::array<ActivePassage, kLanes> active_;
  std::deque<ActivePassage> waiting_;
};

SimdEngine::SimdEngine(const Kernels& kernels, Done done) : kernels_(kernels), done_(std::move(done)) {}
SimdEngine::~SimdEngine() = default;

SimdEngine::LaneSet& SimdEngine::lane_set_for(const PassageTask& task, bool near_pole) {
  for (const auto& set : sets_)
    if (set->serves(task, near_pole)) return *set;
  std::shared_ptr<const ModulationTable> modulation;
  for (const auto& set : sets_)
    if (set->has_modulation_of(task)) modulation = set->modulation();
  const Bristle<double>& b = task.bristle;
  if (!modulation) modulation = std::make_shared<ModulationTable>(b.friction, b.friction_constants);
  sets_.push_back(std::make_unique<LaneSet>(*this, task, std::move(modulation), near_pole));
  return *sets_.back();
}

// Removes idle lane sets if there are many, as in a sweep over the parameters of friction.
void SimdEngine::remove_idle_sets() {
  if (sets_.size() <= kMaxIdleSets) return;
  const auto idle =
      std::stable_partition(sets_.begin(), sets_.end(), [](const auto& set) { return set->demand() > 0; });
  for (auto set = idle; set != sets_.end(); ++set) lane_steps_ += (*set)->lane_steps();
  sets_.erase(idle, sets_.end());
}

void SimdEngine::submit(const PassageTask& task, std::size_t ticket) {
  ActivePassage active{task, ticket, pack(state_at_rest(task.bristle, task.start))};
  active.x_0 = active.y[component::X];
  active.near_pole = has_pole(task.bristle.bending) && task.integrator.method == Method::implicit_only;
  remove_idle_sets();
  lane_set_for(task, active.near_pole).add(std::move(active));
}

SimdEngine::Usage SimdEngine::usage() const {
  Usage usage;
  usage.passage_steps = passage_steps_;
  usage.lane_steps = lane_steps_;
  for (const auto& set : sets_) usage.lane_steps += set->lane_steps();
  return usage;
}

bool SimdEngine::advance() {
  const auto by_demand = [](const auto& a, const auto& b) {
    return std::min<std::size_t>(a->demand(), kLanes) < std::min<std::size_t>(b->demand(), kLanes);
  };
  ended_ = 0;
  while (ended_ == 0) {
    const auto busiest = std::max_element(sets_.begin(), sets_.end(), by_demand);
    if (busiest == sets_.end() || (*busiest)->demand() == 0) return false;
    (*busiest)->run();
  }
  return true;
}

}  // namespace bristle
