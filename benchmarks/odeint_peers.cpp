// A shared library of its own, because it is compiled with -march=native: the linker cannot use its copies of
// inline functions in the rest of the program.
#include "odeint_peers.hpp"

#include "bristle/dynamics/ode.hpp"
#include "bristle/dynamics/rules.hpp"

#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_cash_karp54.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace bristle::bench {
namespace odeint = boost::numeric::odeint;
namespace {

constexpr double kSlipTolerance = 1e-10;  // of the exit, in r0
constexpr long kMaxAttempts = 50'000'000;
constexpr int kMaxShortened = 100;

// A number with the C library's elementary functions.
struct Libm {
  Libm() = default;
  Libm(double value) : value(value) {}
  double value;
  friend Libm operator-(Libm a) { return -a.value; }
  friend Libm operator+(Libm a, Libm b) { return a.value + b.value; }
  friend Libm operator-(Libm a, Libm b) { return a.value - b.value; }
  friend Libm operator*(Libm a, Libm b) { return a.value * b.value; }
  friend Libm operator/(Libm a, Libm b) { return a.value / b.value; }
  friend bool operator<(Libm a, Libm b) { return a.value < b.value; }
  friend Libm inverse_sqrt(Libm x) { return 1 / std::sqrt(x.value); }
  friend Libm decay(Libm x) { return x.value < kNegligible ? 0 : std::exp(x.value); }
  friend Libm atan(Libm x) { return std::atan(x.value); }
  friend Libm sin(Libm x) { return std::sin(x.value); }
  friend Libm interpolated(const ModulationTable& table, Libm u) { return table.at(u.value); }
};

struct System {
  const Bristle<double>& bristle;
  long& evaluations;
  void operator()(const OdeState& y, OdeState& dydt, double) const {
    ++evaluations;
    std::array<Libm, COMPONENTS> slope;
    derivative<Libm>(bristle, y, slope);
    for (int c = 0; c < COMPONENTS; ++c) dydt[c] = slope[c].value;
  }
};

// All steps start from a slope that is passed to Odeint, which therefore keeps none of its own: after a step
// that is repeated, a kept slope would be that of another state.
template <class Stepper>
class Integration {
  using Controlled = odeint::controlled_runge_kutta<Stepper>;

 public:
  Integration(const PassageTask& task, OdeState& y)
      : system_{task.bristle, evaluations_},
        stepper_(typename Controlled::error_checker_type(task.integrator.atol, task.integrator.rtol)),
        y_(y) {
    const double x_0 = y[component::X], L_x = task.parameters->L_x;
    const auto excess = [&] {
      return t_new_ - (y_new_[component::X] - x_0) - L_x;
    };  // of the slip beyond the exit
    system_(y_, slope_, 0);
    for (long attempt = 0; attempt < kMaxAttempts; ++attempt) {
      const double tried = h_;
      t_new_ = t_;
      if (attempt_step() != odeint::success) continue;
      // Odeint accepts a step whose error is not a number.
      if (!std::ranges::all_of(y_new_, [](double value) { return std::isfinite(value); })) {
        h_ = tried / 5;
        continue;
      }
      if (excess() > kSlipTolerance) shorten(tried, excess);
      accept();
      if (excess() >= -kSlipTolerance) return;
    }
    throw std::runtime_error("Odeint found no exit");
  }
  OdeintExit exit() const { return {t_, evaluations_}; }

 private:
  static constexpr bool kLastSlopeIsFirst =  // of the next step
      std::is_same_v<typename Stepper::stepper_category, odeint::explicit_error_stepper_fsal_tag>;

  // Steps from y_ to y_new_; on success changes t_new_ to the end of the step. Sets h_ to the next size.
  odeint::controlled_step_result attempt_step() {
    if constexpr (kLastSlopeIsFirst)
      return stepper_.try_step(system_, y_, slope_, t_new_, y_new_, slope_new_, h_);
    else return stepper_.try_step(system_, y_, slope_, t_new_, y_new_, h_);
  }

  // A step of size h whose error is not controlled: it is part of one whose error was small enough.
  void step(double h) {
    if constexpr (kLastSlopeIsFirst)
      stepper_.stepper().do_step(system_, y_, slope_, t_, y_new_, slope_new_, h);
    else stepper_.stepper().do_step(system_, y_, slope_, t_, y_new_, h);
    t_new_ = t_ + h;
  }

  void accept() {
    y_ = y_new_;
    t_ = t_new_;
    if constexpr (kLastSlopeIsFirst) slope_ = slope_new_;
    else system_(y_, slope_, t_);
  }

  // Repeats a step of size h, which passed the exit, until it ends there: by Newton's method, within bounds.
  template <class Excess>
  void shorten(double h, Excess excess) {
    double shortest = 0, longest = h;
    for (int i = 0; i < kMaxShortened && std::abs(excess()) > kSlipTolerance; ++i) {
      (excess() < 0 ? shortest : longest) = h;
      h -= excess() / (1 - y_new_[component::VX]);
      if (!(shortest < h && h < longest)) h = 0.5 * (shortest + longest);
      step(h);
    }
  }

  long evaluations_ = 0;
  System system_;
  Controlled stepper_;
  OdeState &y_, y_new_, slope_, slope_new_;
  double t_ = 0, t_new_ = 0, h_ = kFirstStep;
};

}  // namespace

OdeintExit odeint_dopri5(const PassageTask& task, OdeState& y) {
  return Integration<odeint::runge_kutta_dopri5<OdeState>>(task, y).exit();
}
OdeintExit odeint_cash_karp(const PassageTask& task, OdeState& y) {
  return Integration<odeint::runge_kutta_cash_karp54<OdeState>>(task, y).exit();
}

}  // namespace bristle::bench
