// Observed order of the integration methods on the equations of the bristle, with walls of range 0.1, soft
// enough for the fixed steps to resolve them.
#include "bristle/dynamics/rosenbrock.hpp"

#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include "catch.hpp"
#include <functional>

namespace bristle::stepper_test {
using namespace component;

namespace {

struct System {
  Bristle<double> b;
  void derivative(const OdeState& y, OdeState& dydt) { bristle::derivative<double>(b, y, dydt); }
  void operator()(const OdeState& y, OdeState& dydt, double) { derivative(y, dydt); }
  void jacobian(const OdeState& y, Jacobian& J) { bristle::jacobian(b, y, J); }
};

System smooth_system() {
  Parameters p;
  p.lambda = p.lambda_z = 0.1;
  p.V_s = 0.5;
  p.tau_f = 300;
  return {make_bristle(p, 0.8, 0.7)};
}

OdeState start() { return pack({{0.3, 0.25, 0.7}, {0.1, 0, 0.2}, 0.69, 1.06}); }

template <class Step>
OdeState integrate(Step step, int steps) {
  System system = smooth_system();
  OdeState y = start();
  for (int i = 0; i < steps; ++i) step(system, y, 0.4 / steps);
  return y;
}

void dopri5(System& system, OdeState& y, double dt) {
  boost::numeric::odeint::runge_kutta_dopri5<OdeState> stepper;
  stepper.do_step(std::ref(system), y, 0.0, dt);
}

void rosenbrock(System& system, OdeState& y, double dt) {
  RosenbrockStep step;
  OdeState out, error;
  step.make(system, y, dt, out, error);
  y = out;
}

double distance(const OdeState& a, const OdeState& b) {
  double d = 0;
  for (int i = 0; i < COMPONENTS; ++i) d = std::max(d, std::abs(a[i] - b[i]));
  return d;
}

template <class Step>
double observed_order(Step step, int steps) {
  const OdeState exact = integrate(dopri5, 4000);
  return std::log2(distance(integrate(step, steps), exact) / distance(integrate(step, 2 * steps), exact));
}

}  // namespace

TEST_CASE("Dormand-Prince converges with order 5 on the bristle's equations") {
  CHECK(observed_order(dopri5, 40) == Approx(5).margin(0.4));
}

TEST_CASE("the Rosenbrock method converges with order 4, state and integrals") {
  CHECK(observed_order(rosenbrock, 40) == Approx(4).margin(0.4));
}

TEST_CASE("the Rosenbrock method's dense output converges with order 4 or better per step") {
  const auto error_at_middle = [](double dt) {
    System system = smooth_system();
    OdeState y = start(), out, error, middle;
    RosenbrockStep step;
    step.make(system, y, dt, out, error);
    step.prepare_dense_output();
    step.interpolate(0.5, y, out, middle);
    OdeState exact = y;
    for (int i = 0; i < 200; ++i) dopri5(system, exact, dt / 2 / 200);
    return distance(middle, exact);
  };
  CHECK(std::log2(error_at_middle(0.02) / error_at_middle(0.01)) > 3.6);
}

TEST_CASE("the Rosenbrock method is stable where an explicit step is not") {
  Parameters p;
  System system{make_bristle(p, 0.6, M_PI)};
  const double s = 1.5e-3;  // c_theta/s^2 = 15 000
  OdeState y = pack({{-s, 1e-5, 0.6}, {0, 0.01, 0}, M_PI - 1e-5 / s, 1.5}), out, error;
  RosenbrockStep step;
  step.make(system, y, 1e-3, out, error);
  CHECK(std::abs(out[VY]) < 0.1);
  dopri5(system, y, 1e-3);
  CHECK(std::abs(y[VY]) > 1);
}

}  // namespace bristle::stepper_test
