#include "dynamics/passage.hpp"

#include "dynamics/rosenbrock.hpp"
#include "dynamics/rules.hpp"
#include "model/elementary.hpp"

#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/dense_output_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>

namespace bristle {
namespace odeint = boost::numeric::odeint;
namespace {

// A pinned bristle oscillates undamped about its place; its means do not depend on the phase, so its
// tolerance may be looser (docs/numerics.md has the measurement).
constexpr double kImplicitFactor = 10;

constexpr double kTimeTolerance = 1e-13;

struct EvaluationLimit {};

// The right-hand side as Odeint calls it, with the cap on its evaluations.
struct System {
  const Bristle<double>& bristle;
  long evaluations;
  long limit;

  void derivative(const OdeState& y, OdeState& dydt) {
    if (++evaluations > limit) throw EvaluationLimit{};
    bristle::derivative<double>(bristle, y, dydt);
  }
  void operator()(const OdeState& y, OdeState& dydt, double) { derivative(y, dydt); }
  void jacobian(const OdeState& y, StateJacobian& J, IntegralJacobian& J_integrals) {
    bristle::jacobian(bristle, y, J, J_integrals);
  }
};

// Largest error over tolerance. A step that is not finite is an infinite error: Odeint's own
// checker takes NaN for a success.
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

// Odeint's rule for the next step, without its call of the C library's pow.
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
using ImplicitController = RosenbrockController;
using ImplicitStepper = odeint::rosenbrock4_dense_output<ImplicitController>;

class Run {
 public:
  Run(const PassageTask& task, const Observer& observe)
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
      End end = End::hand_over;
      if (options_.method != Method::implicit_only) end = advance_explicit();
      if (end == End::hand_over) {
        implicit_ = true;
        end = advance_implicit();
      }
      return outcome_at_exit(p_, y_);
    } catch (const EvaluationLimit&) {
      return Outcome::step_limit;
    } catch (const odeint::odeint_error&) {  // no step size was small enough
      return Outcome::not_finite;
    }
  }

  void report(Passage& out) {
    out.contact_time = t_;
    out.end = y_;
    out.steps = steps_;
    out.evaluations = system_.evaluations;
    out.reflections = reflections_;
    out.implicit = implicit_;
    out.samples = std::move(samples_);
  }

 private:
  enum class End {
    exit,
    hand_over
  };

  End advance_explicit() {
    ExplicitStepper stepper(ControlledDopri5(ErrorChecker(options_.atol, options_.rtol)));
    return advance(stepper, [this] {
      return options_.method == Method::automatic &&
             (steps_ >= kExplicitSteps || in_plane_distance(y_) < kStiffRanges * p_.lambda);
    });
  }

  End advance_implicit() {
    ImplicitStepper stepper(
        ImplicitController(kImplicitFactor * options_.atol, kImplicitFactor * options_.rtol));
    return advance(stepper, [] { return false; });
  }

  // Steps until the exit or until hand_over(); leaves time and state there.
  template <class Stepper, class HandOver>
  End advance(Stepper& stepper, HandOver hand_over) {
    stepper.initialize(y_, t_, dt_);
    while (!hand_over()) {
      const auto [from, to] = stepper.do_step(std::ref(system_));
      ++steps_;
      const auto along = [&stepper](double t) { return state_at(stepper, t); };
      const double pole = pole_contact(along, p_.s_min, from, to, kTimeTolerance);
      const double end = std::min(pole, to);
      const OdeState at_end = end < to ? state_at(stepper, end) : stepper.current_state();
      const bool exits = slip(end, at_end) >= p_.L_x;
      if (exits) {
        t_ = root_in([&](double t) { return slip(t, along(t)) - p_.L_x; }, from, end, kTimeTolerance);
        y_ = state_at(stepper, t_);
      } else {
        t_ = end;
        y_ = at_end;
        dt_ = stepper.current_time_step();
      }
      sample(along);
      if (!exits && pole <= to) {
        if (answer_pole(p_.pole_rule, y_)) ++reflections_;
        stepper.initialize(y_, t_, std::min(dt_, kFirstStep));
      }
      if (observe_) observe_(t_, y_);
      if (exits) return End::exit;
    }
    return End::hand_over;
  }

  // Up to the present time, by the dense output of the step that led there.
  template <class Along>
  void sample(Along along) {
    for (double at; interval_ > 0 && (at = double(samples_.size() + 1) * interval_) < t_;) {
      const OdeState y = along(at);
      samples_.push_back({y[NORMAL], y[FRICTION_X], y[FRICTION_Y]});
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
  double x_0_, t_ = 0, dt_ = kFirstStep;
  System system_;
  long steps_ = 0;
  double interval_;
  std::vector<PathSample> samples_;
  int reflections_ = 0;
  bool implicit_ = false;
};

}  // namespace

void complete(const PassageTask& task, Passage& out) {
  out.outcome = outcome_at_exit(*task.parameters, out.end);
  const double T = out.contact_time, I_n = out.end[NORMAL];
  out.gamma_1 = out.end[MODULATION] / I_n;
  out.gamma_2 = out.end[ALIGNMENT] / I_n;
  const double mean_root = cbrt(I_n / T);
  out.gamma_3 = out.end[AREA] / T / (mean_root * mean_root);
  const State<double> at_rest = state_at_rest(task.bristle, task.start);
  const double gained = energy(task.bristle, unpack<double>(out.end)) - energy(task.bristle, at_rest);
  const double dissipated = out.end[FRICTION_X] - out.end[WORK];
  out.energy_residual = std::abs(gained - out.end[WORK]) / dissipated;
}

Passage run_passage(const PassageTask& task, const Observer& observe) {
  Passage out;
  out.theta_0 = task.bristle.theta_0;
  Run run(task, observe);
  out.outcome = run.integrate();
  run.report(out);
  if (out.complete()) complete(task, out);
  return out;
}

}  // namespace bristle
