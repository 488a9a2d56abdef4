#include "odeint_peers.hpp"

#include "dynamics/ode.hpp"

#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_cash_karp54.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <algorithm>
#include <cmath>

namespace bristle::bench {
namespace odeint = boost::numeric::odeint;
namespace {

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
  friend Libm inverse_sqrt(Libm x) { return 1 / std::sqrt(x.value); }
  friend Libm decay(Libm x) { return x.value < kNegligible ? 0 : std::exp(x.value); }
  friend Libm atan(Libm x) { return std::atan(x.value); }
  friend Libm sin(Libm x) { return std::sin(x.value); }
};

double slip(const OdeState& y, double t, double x_0) { return t - (y[X] - x_0); }

template <class Stepper>
Passage run(const PassageTask& task) {
  const auto system = [&b = task.bristle](const OdeState& y, OdeState& dydt, double) {
    std::array<Libm, COMPONENTS> in, out;
    for (int i = 0; i < COMPONENTS; ++i) in[i] = y[i];
    derivative<Libm>(b, in, out);
    for (int i = 0; i < COMPONENTS; ++i) dydt[i] = out[i].value;
  };
  auto stepper = odeint::make_controlled<Stepper>(task.integrator.atol, task.integrator.rtol);
  OdeState y = pack(state_at_rest(task.bristle, task.start));
  const double x_0 = y[X], L_x = task.parameters->L_x;
  double t = 0, h = 1e-5;
  while (slip(y, t, x_0) < L_x - 1e-10) {
    OdeState y_new = y;
    double t_new = t;
    if (stepper.try_step(system, y_new, t_new, h) != odeint::success) continue;
    const double from = slip(y, t, x_0), to = slip(y_new, t_new, x_0);
    if (!(to <= L_x + 1e-10)) {  // repeats the step so that it ends at the exit; Odeint accepts NaN
      h = (t_new - t) * std::max(0.01, (L_x - from) / (to - from));
      if constexpr (requires { stepper.reset(); }) stepper.reset();
      continue;
    }
    y = y_new;
    t = t_new;
  }
  Passage out;
  out.outcome = Outcome::left;
  out.contact_time = t;
  out.end = y;
  return out;
}

template <class Stepper>
std::vector<Passage> run_all(const std::vector<PassageTask>& tasks) {
  std::vector<Passage> out;
  for (const PassageTask& task : tasks) out.push_back(run<Stepper>(task));
  return out;
}

}  // namespace

std::vector<Passage> run_odeint_dopri5(const std::vector<PassageTask>& tasks) {
  return run_all<odeint::runge_kutta_dopri5<OdeState>>(tasks);
}
std::vector<Passage> run_odeint_cash_karp(const std::vector<PassageTask>& tasks) {
  return run_all<odeint::runge_kutta_cash_karp54<OdeState>>(tasks);
}

}  // namespace bristle::bench
