#pragma once

#include "bristle/dynamics/jacobian.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <boost/numeric/odeint/integrate/max_step_checker.hpp>
#include <functional>
#include <utility>

namespace bristle {

// The coefficients of Hairer and Wanner's method RODAS, of order 4(3), for systems that do not depend on
// time.
namespace rodas {
constexpr int kStages = 6;
constexpr double kGamma = 0.25;
// Weights of the earlier stages in the state at which a stage evaluates the equations. The last stage has
// those of the stage before it, whose result it adds.
constexpr double kStates[kStages - 1][kStages - 2] = {
    {},
    {1.544},
    {0.9466785280815826, 0.2557011698983284},
    {3.314825187068521, 2.896124015972201, 0.9986419139977817},
    {1.221224509226641, 6.019134481288629, 12.53708332932087, -0.6878860361058950}};
// Weights of the earlier stages, over the size of the step, on the right-hand side of a stage.
constexpr double kSides[kStages][kStages - 1] = {
    {},
    {-5.6688},
    {-2.430093356833875, -0.2063599157091915},
    {-0.1073529058151375, -9.594562251023355, -20.47028614809616},
    {7.496443313967647, -10.24680431464352, -33.99990352819905, 11.70890893206160},
    {8.083246795921522, -7.981132988064893, -31.52159432874371, 16.31930543123136, -6.058818238834054}};
// Weights of the stages in the two terms of the dense output.
constexpr double kDense[2][kStages - 1] = {
    {10.12623508344586, -7.487995877610167, -34.80091861555747, -7.992771707568823, 1.025137723295662},
    {-0.6762803392801253, 6.087714651680015, 16.43084320892478, 24.76722511418386, -6.594389125716872}};
}  // namespace rodas

// A step of the method RODAS, and its dense output. Eigen factorises the 8 x 8 block of the state; the
// integrals follow by substitution.
class RosenbrockStep {
 public:
  // Makes one step of an autonomous system with members derivative(y, dydt) and jacobian(y, J).
  template <class System>
  void make(System& system, const OdeState& y, double dt, OdeState& y_out, OdeState& y_err) {
    using namespace rodas;
    system.jacobian(y, J_);
    factorise(1 / (kGamma * dt));
    OdeState at, side;
    for (int stage = 0; stage < kStages; ++stage) {
      const bool last = stage == kStages - 1;
      for (int i = 0; i < COMPONENTS; ++i)
        at[i] = last ? at[i] + stages_[stage - 1][i] : plus_stages(y[i], kStates[stage], 0, stage, i);
      system.derivative(at, side);
      for (int i = 0; stage > 0 && i < COMPONENTS; ++i)
        side[i] += plus_stages(kSides[stage][0] * stages_[0][i], kSides[stage], 1, stage, i) / dt;
      solve(side, last ? y_err : stages_[stage]);
    }
    for (int i = 0; i < COMPONENTS; ++i) y_out[i] = at[i] + y_err[i];
  }

  void prepare_dense_output() {
    for (int term : {0, 1})
      for (int i = 0; i < COMPONENTS; ++i) {
        const auto& weights = rodas::kDense[term];
        dense_[term][i] = plus_stages(weights[0] * stages_[0][i], weights, 1, rodas::kStages - 1, i);
      }
  }

  // Sets y to the state between the start (u = 0) and the end (u = 1) of the last step.
  void interpolate(double u, const OdeState& y_old, const OdeState& y_new, OdeState& y) const {
    const double w = 1 - u;
    for (int i = 0; i < COMPONENTS; ++i)
      y[i] = y_old[i] * w + u * (y_new[i] + w * (dense_[0][i] + u * dense_[1][i]));
  }

 private:
  // Returns the sum plus the component i of the stages from `first` to before `end`, with their weights.
  double plus_stages(double sum, const double* weights, int first, int end, int i) const {
    for (int stage = first; stage < end; ++stage) sum += weights[stage] * stages_[stage][i];
    return sum;
  }

  // Factorises diagonal - J.
  void factorise(double diagonal) {
    diagonal_ = diagonal;
    StateMatrix matrix;
    for (int i = 0; i < kState; ++i)
      for (int j = 0; j < kState; ++j) matrix(i, j) = diagonal * (i == j) - J_[i][j];
    factorisation_.compute(matrix);
  }

  // Solves (diagonal - J) out = side: first for the state, then for the integrals.
  void solve(const OdeState& side, OdeState& out) const {
    using Column = Eigen::Matrix<double, kState, 1>;
    Eigen::Map<Column>(out.data()) = factorisation_.solve(Eigen::Map<const Column>(side.data()));
    for (int i = kState; i < COMPONENTS; ++i) {
      double sum = J_[i][0] * out[0];
      for (int j = 1; j < kState; ++j) sum += J_[i][j] * out[j];
      out[i] = (side[i] + sum) / diagonal_;
    }
  }

  using StateMatrix = Eigen::Matrix<double, kState, kState>;
  Jacobian J_{};
  double diagonal_ = 0;
  Eigen::PartialPivLU<StateMatrix> factorisation_{StateMatrix(StateMatrix::Identity())};
  OdeState stages_[rodas::kStages - 1]{};
  OdeState dense_[2]{};  // the two terms
};

// Steps with dense output and a step size by K. Gustafsson's prediction, with square roots instead of the C
// library's pow. The interface is that of Odeint's steppers with dense output.
class RosenbrockStepper {
 public:
  RosenbrockStepper(double atol, double rtol) : atol_(atol), rtol_(rtol) {}

  void initialize(const OdeState& y, double t, double dt) {
    current_ = y;
    t_ = t;
    dt_ = dt;
  }

  // Makes one step and returns its interval. Throws Odeint's step_adjustment_error if no size is accepted.
  template <class System>
  std::pair<double, double> do_step(std::reference_wrapper<System> system) {
    boost::numeric::odeint::failed_step_checker count_attempt;
    t_old_ = t_;
    for (bool accepted = false; !accepted; count_attempt()) accepted = try_step(system.get());
    step_.prepare_dense_output();
    std::swap(current_, other_);
    return {t_old_, t_};
  }

  void calc_state(double t, OdeState& y) const {
    step_.interpolate((t - t_old_) / (t_ - t_old_), other_, current_, y);
  }
  const OdeState& current_state() const { return current_; }
  double current_time_step() const { return dt_; }

 private:
  // Makes one step to other_ and chooses the size of the next one. Returns whether it is accepted.
  template <class System>
  bool try_step(System& system) {
    OdeState y_err;
    step_.make(system, current_, dt_, other_, y_err);
    const double err = error(other_, y_err);
    double divisor = step_divisor(fourth_root(err));
    if (!(err <= 1)) {
      dt_ /= divisor;
      rejected_ = true;
      return false;
    }
    if (!first_) divisor = std::max(divisor, step_divisor(dt_old_ / dt_ * fourth_root(err * err / err_old_)));
    first_ = false;
    dt_old_ = dt_;
    err_old_ = std::max(0.01, err);
    t_ += dt_;
    dt_ = rejected_ ? std::min(dt_ / divisor, dt_) : dt_ / divisor;
    rejected_ = false;
    return true;
  }

  // Returns the root mean square of the ratios of error to tolerance.
  double error(const OdeState& y, const OdeState& y_err) const {
    double sum = 0;
    for (int i = 0; i < COMPONENTS; ++i) {
      const double scale = atol_ + rtol_ * std::max(std::abs(current_[i]), std::abs(y[i]));
      sum += y_err[i] * y_err[i] / scale / scale;
    }
    return std::sqrt(sum / COMPONENTS);
  }
  static double fourth_root(double x) { return std::sqrt(std::sqrt(x)); }
  // Returns the divisor of the step size, with a safety factor of 0.9; 5 for a step that is not finite.
  static double step_divisor(double root) { return std::max(1.0 / 6, std::min(5.0, root / 0.9)); }

  double atol_, rtol_;
  RosenbrockStep step_;
  OdeState current_{}, other_{};  // other_: where the last step began, or ends if it is accepted
  double t_ = 0, t_old_ = 0, dt_ = 0;
  bool first_ = true, rejected_ = false;
  double dt_old_ = 0, err_old_ = 0;  // of the last accepted step
};

}  // namespace bristle
