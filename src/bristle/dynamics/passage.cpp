#include "bristle/dynamics/passage.hpp"

#include "bristle/dynamics/rosenbrock.hpp"
#include "bristle/dynamics/rules.hpp"
#include "bristle/model/elementary.hpp"

#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/dense_output_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>

namespace bristle {

using namespace component;
namespace odeint = boost::numeric::odeint;
namespace {

// Factor by which the tolerance of the implicit method is looser. A pinned bristle oscillates undamped about
// its equilibrium; its means do not depend on the phase, so that a looser tolerance suffices (measured in
// docs/numerics.md).
constexpr double kImplicitToleranceFactor = 3;

// Number of explicit steps after which the implicit method takes over even far from the pole: more than an
// ordinary passage needs.
constexpr long kExplicitSteps = 6000;

constexpr double kTimeTolerance = 1e-13;  // for the times of exit and pole contact

struct EvaluationLimit {};

// The right-hand side in the form that Odeint calls. Limits the number of evaluations.
struct System {
  const Bristle<double>& bristle;
  long evaluations;
  long limit;

  void derivative(const OdeState& y, OdeState& dydt) {
    if (++evaluations > limit) throw EvaluationLimit{};
    bristle::derivative<double>(bristle, y, dydt);
  }
  void operator()(const OdeState& y, OdeState& dydt, double) { derivative(y, dydt); }
  void jacobian(const OdeState& y, Jacobian& J) { bristle::jacobian(bristle, y, J); }
};

// Computes the largest ratio of error to tolerance. A step that is not finite has a ratio of 1e6: Odeint's
// own checker accepts NaN.
class ErrorChecker {
 public:
  ErrorChecker(double atol, double rtol) : atol_(atol), rtol_(rtol) {}
  template <class Algebra>
  double error(Algebra&, const OdeState& y, const OdeState&, const OdeState& y_err, double) const {
    double largest = 0;
    for (int i = 0; i < COMPONENTS; ++i) {
      const double e = std::abs(y_err[i]) / (atol_ + rtol_ * std::abs(y[i]));
      if (!(e < 1e6)) return 1e6;
      largest = std::max(largest, e);
    }
    return largest;
  }

 private:
  double atol_, rtol_;
};

// Odeint's rule for the step size, with pow() of model/elementary.hpp instead of the C library's.
class StepAdjuster {
 public:
  double decrease_step(double dt, double error, int error_order) const {
    return dt * std::max(0.9 * pow(error, -1.0 / (error_order - 1)), 0.2);
  }
  double increase_step(double dt, double error, int stepper_order) const {
    if (error >= 0.5) return dt;
    return dt * 0.9 * pow(std::max(pow(5, -stepper_order), error), -1.0 / stepper_order);
  }
  bool check_step_size_limit(double) const { return true; }
  double get_max_dt() const { return 0; }
};

using Dopri5 = odeint::runge_kutta_dopri5<OdeState>;
using ControlledDopri5 = odeint::controlled_runge_kutta<Dopri5, ErrorChecker, StepAdjuster>;
using ExplicitStepper = odeint::dense_output_runge_kutta<ControlledDopri5>;

class PassageIntegrator {
 public:
  PassageIntegrator(const PassageTask& task, const Observer& observe)
      : p_(*task.parameters),
        options_(task.integrator),
        observe_(observe),
        y_(pack(state_at_rest(task.bristle, task.start))),
        x_0_(y_[X]),
        system_{task.bristle, 0, options_.max_evaluations},
        interval_(task.sample_interval) {}

  Outcome integrate() {
    if (observe_) observe_(t_, y_);
    try {
      StopReason reason = StopReason::hand_over;
      if (options_.method != Method::implicit_only) reason = advance_explicit();
      if (reason == StopReason::hand_over) {
        implicit_ = true;
        advance_implicit();
      }
      return outcome_at_exit(p_, y_);
    } catch (const EvaluationLimit&) {
      return Outcome::step_limit;
    } catch (const odeint::odeint_error&) {  // Odeint found no acceptable step size
      return Outcome::not_finite;
    }
  }

  void store_in(Passage& out) {
    out.contact_time = t_;
    out.end = y_;
    out.path = path_;
    out.steps = steps_;
    out.evaluations = system_.evaluations;
    out.reflections = reflections_;
    out.implicit = implicit_;
    out.samples = std::move(samples_);
  }

 private:
  enum class StopReason {
    exit,
    hand_over
  };

  StopReason advance_explicit() {
    ExplicitStepper stepper(ControlledDopri5(ErrorChecker(options_.atol, options_.rtol)));
    return advance(stepper, [this] {
      return options_.method == Method::automatic &&
             (steps_ >= kExplicitSteps ||
              (has_pole(p_.bending) && singular_distance(p_.bending, y_) < kStiffRanges * p_.lambda));
    });
  }

  StopReason advance_implicit() {
    RosenbrockStepper stepper(kImplicitToleranceFactor * options_.atol,
                              kImplicitToleranceFactor * options_.rtol);
    return advance(stepper, [] { return false; });
  }

  // Steps until the exit or until hand_over() is true. Updates the time t_ and the state y_.
  template <class Stepper, class HandOver>
  StopReason advance(Stepper& stepper, HandOver hand_over) {
    stepper.initialize(y_, t_, dt_);
    while (!hand_over()) {
      const auto [from, to] = stepper.do_step(std::ref(system_));
      ++steps_;
      const auto dense_output = [&stepper](double t) { return state_at(stepper, t); };
      const double pole_time = pole_contact(dense_output, p_, from, to, kTimeTolerance);
      const double end = std::min(pole_time, to);
      const OdeState at_end = end < to ? state_at(stepper, end) : stepper.current_state();
      const bool exits = slip(end, at_end) >= p_.L_x;
      if (exits) {
        t_ = first_root([&](double t) { return slip(t, dense_output(t)) - p_.L_x; }, from, end,
                        kTimeTolerance);
        y_ = state_at(stepper, t_);
      } else {
        t_ = end;
        y_ = at_end;
        dt_ = stepper.current_time_step();
      }
      sample(dense_output);
      add_step(from, dense_output);
      if (!exits && pole_time <= to) {
        if (apply_pole_rule(p_, y_)) ++reflections_;
        stepper.initialize(y_, t_, std::min(dt_, kFirstStep));
      }
      if (observe_) observe_(t_, y_);
      if (exits) return StopReason::exit;
    }
    return StopReason::hand_over;
  }

  // Appends the samples of the last step, up to the time t_.
  template <class DenseOutput>
  void sample(DenseOutput dense_output) {
    for (double t; interval_ > 0 && (t = double(samples_.size() + 1) * interval_) < t_;) {
      const OdeState y = dense_output(t);
      samples_.push_back({y[NORMAL], y[FRICTION_X], y[FRICTION_Y]});
    }
  }

  // Adds the last step, up to the time t_, to the path: times by equal weights of three instants, all other
  // integrals by Simpson's rule.
  template <class DenseOutput>
  void add_step(double from, DenseOutput dense_output) {
    const double h = t_ - from;
    for (const auto& [share, weight] : {std::pair{0., 1. / 6}, {0.5, 4. / 6}, {1., 1. / 6}}) {
      const auto state = unpack<double>(share == 1 ? y_ : dense_output(from + share * h));
      const auto m = motion(system_.bristle, state);
      add_instant(system_.bristle, state.r[2], m.contact, m.sliding, m.friction, weight * h, h / 3, path_);
      if (share == 0)
        add_position(system_.bristle, state.r, frame_at(state.r, has_pole(system_.bristle.bending)), x_0_,
                     path_);
    }
  }

  double slip(double t, const OdeState& y) const { return t - (y[X] - x_0_); }

  template <class Stepper>
  static OdeState state_at(Stepper& stepper, double t) {
    OdeState y;
    stepper.calc_state(t, y);
    return y;
  }

  const Parameters& p_;
  const IntegratorOptions& options_;
  const Observer& observe_;
  OdeState y_;
  Path<double> path_{};
  double x_0_, t_ = 0, dt_ = kFirstStep;
  System system_;
  long steps_ = 0;
  double interval_;
  std::vector<PathSample> samples_;
  int reflections_ = 0;
  bool implicit_ = false;
};

}  // namespace

void evaluate_exit(const PassageTask& task, Passage& out) {
  out.outcome = outcome_at_exit(*task.parameters, out.end);
  const double T = out.contact_time, I_n = out.end[NORMAL];
  if (I_n < kNoLoad) {  // at first contact: the limits for a tip at rest under a vanishing load
    out.gamma_1 = modulation(*task.parameters, 1);
    out.gamma_2 = out.gamma_3 = 1;
  } else {
    out.gamma_1 = out.end[MODULATION] / I_n;
    out.gamma_2 = out.end[ALIGNMENT] / I_n;
    const double mean_root = cbrt(I_n / T);
    out.gamma_3 = out.end[AREA] / T / (mean_root * mean_root);
  }
  const State<double> at_rest = state_at_rest(task.bristle, task.start), end = unpack<double>(out.end);
  add_position(task.bristle, end.r, frame_at(end.r, has_pole(task.bristle.bending)), at_rest.r[0], out.path);
  const double start = energy(task.bristle, at_rest);
  const double gained = energy(task.bristle, end) - start;
  const double dissipated = out.end[FRICTION_X] - out.end[WORK];
  // A tip that the slab hardly touches has no more energy than the tolerances of the integrator.
  constexpr double least = 1e-6;
  out.entry_energy = start;
  out.energy_residual = std::abs(gained - out.end[WORK]) / std::max({dissipated, start, least});
}

Passage run_passage(const PassageTask& task, const Observer& observe) {
  Passage out;
  out.theta_0 = task.bristle.theta_0;
  PassageIntegrator integrator(task, observe);
  out.outcome = integrator.integrate();
  integrator.store_in(out);
  if (out.complete()) evaluate_exit(task, out);
  return out;
}

}  // namespace bristle
