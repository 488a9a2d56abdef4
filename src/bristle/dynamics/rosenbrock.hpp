#pragma once

#include "bristle/dynamics/jacobian.hpp"

#include <Eigen/LU>
#include <boost/numeric/odeint/stepper/rosenbrock4.hpp>
#include <boost/numeric/odeint/stepper/rosenbrock4_controller.hpp>
#include <boost/numeric/odeint/stepper/rosenbrock4_dense_output.hpp>
#include <boost/numeric/odeint/util/resizer.hpp>
#include <boost/numeric/odeint/util/state_wrapper.hpp>

namespace bristle {

// Rosenbrock method of order 4(3) with the coefficients and the interface of Odeint's rosenbrock4, for states
// of fixed size. Eigen factorises the 8 x 8 block of the state; the integrals follow by substitution. The
// class is meant for Odeint's rosenbrock4_controller and rosenbrock4_dense_output.
class Rosenbrock4 {
 public:
  using value_type = double;
  using time_type = double;
  using state_type = OdeState;
  using deriv_type = OdeState;
  using wrapped_state_type = boost::numeric::odeint::state_wrapper<OdeState>;
  using wrapped_deriv_type = wrapped_state_type;
  using resizer_type = boost::numeric::odeint::never_resizer;
  using stepper_category = boost::numeric::odeint::stepper_tag;

  // Makes one step of an autonomous system with members derivative(y, dydt) and jacobian(y, J, J_integrals).
  // System is a std::reference_wrapper because Odeint's drivers copy it.
  template <class System>
  void do_step(System reference, const OdeState& y, double /*t*/, OdeState& y_out, double dt,
               OdeState& y_err) {
    auto& system = reference.get();
    StateJacobian J;
    system.jacobian(y, J, J_integrals_);
    diagonal_ = 1 / (c_.gamma * dt);
    factorisation_.compute(StateJacobian(diagonal_ * StateJacobian::Identity() - J));

    const Eigen::Map<const Column> start(y.data());
    Column f = evaluate(system, start);
    g1_ = solve(f);
    f = evaluate(system, start + c_.a21 * g1_);
    g2_ = solve(f + c_.c21 * g1_ / dt);
    f = evaluate(system, start + c_.a31 * g1_ + c_.a32 * g2_);
    g3_ = solve(f + (c_.c31 * g1_ + c_.c32 * g2_) / dt);
    f = evaluate(system, start + c_.a41 * g1_ + c_.a42 * g2_ + c_.a43 * g3_);
    g4_ = solve(f + (c_.c41 * g1_ + c_.c42 * g2_ + c_.c43 * g3_) / dt);
    Column next = start + c_.a51 * g1_ + c_.a52 * g2_ + c_.a53 * g3_ + c_.a54 * g4_;
    f = evaluate(system, next);
    g5_ = solve(f + (c_.c51 * g1_ + c_.c52 * g2_ + c_.c53 * g3_ + c_.c54 * g4_) / dt);
    next += g5_;
    f = evaluate(system, next);
    const Column error =
        solve(f + (c_.c61 * g1_ + c_.c62 * g2_ + c_.c63 * g3_ + c_.c64 * g4_ + c_.c65 * g5_) / dt);
    Eigen::Map<Column>(y_err.data()) = error;
    Eigen::Map<Column>(y_out.data()) = next + error;
  }

  void prepare_dense_output() {
    third_ = c_.d21 * g1_ + c_.d22 * g2_ + c_.d23 * g3_ + c_.d24 * g4_ + c_.d25 * g5_;
    fourth_ = c_.d31 * g1_ + c_.d32 * g2_ + c_.d33 * g3_ + c_.d34 * g4_ + c_.d35 * g5_;
  }

  void calc_state(double t, OdeState& y, const OdeState& y_old, double t_old, const OdeState& y_new,
                  double t_new) const {
    const double u = (t - t_old) / (t_new - t_old), w = 1 - u;
    for (int i = 0; i < COMPONENTS; ++i)
      y[i] = y_old[i] * w + u * (y_new[i] + w * (third_[i] + u * fourth_[i]));
  }

 private:
  using Column = Eigen::Matrix<double, COMPONENTS, 1>;

  template <class System>
  static Column evaluate(System& system, const Column& at) {
    OdeState y, dydt;
    Eigen::Map<Column>(y.data()) = at;
    system.derivative(y, dydt);
    return Eigen::Map<Column>(dydt.data());
  }

  // Solves (1/(gamma dt) - J) g = rhs: first for the state, then for the integrals.
  Column solve(const Column& rhs) const {
    Column g;
    g.head<kState>() = factorisation_.solve(rhs.head<kState>());
    g.tail<kIntegrals>() = (rhs.tail<kIntegrals>() + J_integrals_ * g.head<kState>()) / diagonal_;
    return g;
  }

  boost::numeric::odeint::default_rosenbrock_coefficients<double> c_;
  Eigen::PartialPivLU<StateJacobian> factorisation_{StateJacobian(StateJacobian::Identity())};
  IntegralJacobian J_integrals_ = IntegralJacobian::Zero();
  double diagonal_ = 0;
  Column g1_ = Column::Zero(), g2_ = g1_, g3_ = g1_, g4_ = g1_, g5_ = g1_;
  Column third_ = g1_, fourth_ = g1_;
};

// Odeint's controller, including K. Gustafsson's prediction, with square roots instead of the C library's
// pow.
class RosenbrockController : public boost::numeric::odeint::rosenbrock4_controller<Rosenbrock4> {
 public:
  using rosenbrock4_controller::rosenbrock4_controller;

  template <class System>
  boost::numeric::odeint::controlled_step_result try_step(System system, const OdeState& y, double& t,
                                                          OdeState& y_out, double& dt) {
    m_stepper.do_step(system, y, t, y_out, dt, m_xerr.m_v);
    const double err = error(y_out, y, m_xerr.m_v);
    double factor = step_divisor(fourth_root(err));
    if (!(err <= 1)) {
      dt /= factor;
      m_last_rejected = true;
      return boost::numeric::odeint::fail;
    }
    if (!m_first_step)
      factor = std::max(factor, step_divisor(m_dt_old / dt * fourth_root(err * err / m_err_old)));
    m_first_step = false;
    m_dt_old = dt;
    m_err_old = std::max(0.01, err);
    t += dt;
    dt = m_last_rejected ? std::min(dt / factor, dt) : dt / factor;
    m_last_rejected = false;
    return boost::numeric::odeint::success;
  }

 private:
  static double fourth_root(double x) { return std::sqrt(std::sqrt(x)); }
  // Returns the divisor of the step size, with a safety factor of 0.9; 5 for a step that is not finite.
  static double step_divisor(double root) { return std::max(1.0 / 6, std::min(5.0, root / 0.9)); }
};

}  // namespace bristle
