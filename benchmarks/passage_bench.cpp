// What a passage costs, and ratios against peers measured in the same run: medians over paired repetitions,
// so that a noisy machine shifts both sides alike. Absolute times are for orientation only.
#include "dynamics/rosenbrock.hpp"
#include "interface/ensemble.hpp"

#include <boost/numeric/odeint/stepper/rosenbrock4.hpp>
#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <functional>

using namespace bristle;

namespace {

constexpr int kRepetitions = 7;

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// Median of peer/ours, and of ours alone.
void compare(const std::string& what, const std::function<void()>& ours, const std::function<void()>& peer) {
  std::vector<double> ratio, own;
  for (int i = 0; i < kRepetitions; ++i) {
    own.push_back(seconds(ours));
    ratio.push_back(seconds(peer) / own.back());
  }
  fmt::print("{:<78} {:>6.2f}   ({:.2f} ms)\n", what, median(ratio), 1e3 * median(own));
}

Parameters paper(double k_r) {
  Parameters p;
  p.k_r = k_r;
  p.C = chi_C_peak_at_V_s(p.A);
  return p;
}

Passage pass(double k_r, double z_0, double degrees, Method method) {
  const Parameters p = paper(k_r);
  const auto b = make_bristle(p, z_0, degrees * M_PI / 180);
  IntegratorOptions options;
  options.method = method;
  options.max_evaluations = 100'000'000;
  return run_passage({&p, b, static_equilibrium(b), options});
}

constexpr int kSteps = 2000;

// The same Rosenbrock steps along a pinned bristle, by this project's stepper and by Odeint's.
struct System {
  Bristle<double> b;
  void derivative(const OdeState& y, OdeState& dydt) { bristle::derivative<double>(b, y, dydt); }
  void jacobian(const OdeState& y, StateJacobian& J, IntegralJacobian& I) { bristle::jacobian(b, y, J, I); }
};

void steps_on_eigen(System system, OdeState y) {
  Rosenbrock4 stepper;
  OdeState out, error;
  for (int i = 0; i < kSteps; ++i, y = out) stepper.do_step(std::ref(system), y, 0.0, out, 1e-4, error);
}

void steps_on_ublas(System system, const OdeState& start) {
  namespace odeint = boost::numeric::odeint;
  using Vector = boost::numeric::ublas::vector<double>;
  using Matrix = boost::numeric::ublas::matrix<double>;
  Vector y(COMPONENTS), out(COMPONENTS), error(COMPONENTS);
  std::copy(start.begin(), start.end(), y.begin());
  const auto f = [&](const Vector& at, Vector& dydt, double) {
    OdeState in, slope;
    std::copy(at.begin(), at.end(), in.begin());
    system.derivative(in, slope);
    std::copy(slope.begin(), slope.end(), dydt.begin());
  };
  const auto J = [&](const Vector& at, Matrix& full, double, Vector& dfdt) {
    OdeState in;
    std::copy(at.begin(), at.end(), in.begin());
    StateJacobian of_state;
    IntegralJacobian of_integrals;
    system.jacobian(in, of_state, of_integrals);
    full.clear();
    dfdt.clear();
    for (int i = 0; i < COMPONENTS; ++i)
      for (int j = 0; j < kState; ++j) full(i, j) = i < kState ? of_state(i, j) : of_integrals(i - kState, j);
  };
  odeint::rosenbrock4<double> stepper;
  for (int i = 0; i < kSteps; ++i, y = out) stepper.do_step(std::make_pair(f, J), y, 0.0, out, 1e-4, error);
}

}  // namespace

int main() {
  fmt::print("ratios: time of the peer over ours, median of {} pairs (our time in brackets)\n", kRepetitions);
  const System system{make_bristle(paper(50), 0.62, M_PI)};
  const OdeState start = pack({{-2e-3, 1e-5, 0.62}, {0, 0.01, 0}, M_PI, 1.5});
  compare(
      "Rosenbrock steps, 15 components: Odeint's on uBLAS / ours on Eigen",
      [&] { steps_on_eigen(system, start); }, [&] { steps_on_ublas(system, start); });
  compare(
      "pinned bristle, k_r 50, theta_0 179.5: explicit only / automatic",
      [] { pass(50, 0.62, 179.5, Method::automatic); }, [] { pass(50, 0.62, 179.5, Method::explicit_only); });
  compare(
      "pinned bristle with reflections, theta_0 179.99: explicit only / automatic",
      [] { pass(50, 0.62, 179.99, Method::automatic); },
      [] { pass(50, 0.62, 179.99, Method::explicit_only); });
  compare(
      "ordinary bristle, k_r 50, theta_0 45: implicit only / automatic",
      [] { pass(50, 0.62, 45, Method::automatic); }, [] { pass(50, 0.62, 45, Method::implicit_only); });
  compare(
      "sticking bristle, k_r 10, z_0 0.1, theta_0 120: implicit only / automatic",
      [] { pass(10, 0.1, 120, Method::automatic); }, [] { pass(10, 0.1, 120, Method::implicit_only); });
  const Interface interface {
    paper(50), {}, {}
  };
  compare(
      "ensemble at k_r 50, z_0 0.62: mean to 1e-3 / decision against R_n = 1",
      [&] { ensemble_against_target(interface, 0.62, 1); }, [&] { ensemble_mean(interface, 0.62); });
}
