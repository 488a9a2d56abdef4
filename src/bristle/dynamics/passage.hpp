#pragma once

#include "bristle/dynamics/ode.hpp"
#include "bristle/model/equations.hpp"
#include "bristle/model/equilibrium.hpp"
#include "bristle/model/path.hpp"
#include "bristle/words.hpp"

#include <functional>
#include <vector>

namespace bristle {

// How a passage ended.
enum class Outcome {
  left,        // reached the trailing edge, not pinned
  pinned,      // reached the trailing edge, held upright at the pole by the pole repulsion
  step_limit,  // the cap on derivative evaluations was reached
  not_finite   // no step size gave a finite state
};
template <>
inline Words words<Outcome>() {
  static constexpr const char* list[] = {"left", "pinned", "step_limit", "not_finite"};
  return list;
}

enum class Method {
  automatic,
  explicit_only,
  implicit_only
};
template <>
inline Words words<Method>() {
  static constexpr const char* list[] = {"automatic", "explicit_only", "implicit_only"};
  return list;
}

struct IntegratorOptions {
  double rtol = 1e-6;
  double atol = 1e-8;
  // automatic: explicit until the bristle is stiff, then implicit. The fast engine has one method, implicit
  // in the stiff terms: there explicit_only and implicit_only choose the lanes far from the pole and near it.
  Method method = Method::automatic;
  long max_evaluations = 2'000'000;  // calls of derivative() per passage, including rejected steps
};

// Integrals of F_n, F_fx and F_fy (see Component) from the start of a passage to one instant.
struct PathSample {
  double normal, friction_x, friction_y;
};

// Result of the passage of one bristle from leading to trailing edge. Dimensionless, see Component.
struct Passage {
  Outcome outcome = Outcome::not_finite;
  double theta_0 = 0;                            // rad
  double contact_time = 0;                       // T = Delta xi
  OdeState end{};                                // state and integrals at the exit
  Path<double> path{};                           // see PathQuantity
  double gamma_1 = 0, gamma_2 = 0, gamma_3 = 0;  // ratios of Eqs. (24-26) for this bristle
  double entry_energy = 0;     // of springs and contact at the start, which the slab's edge has brought in
  double energy_residual = 0;  // |E(T) - E(0) - work| over the largest of dissipated energy, E(0) and 1e-6
  long steps = 0, evaluations = 0;
  int reflections = 0;              // number of applications of the pole rule, at s = s_min
  bool implicit = false;            // the implicit method, or the lanes near the pole, were used
  std::vector<PathSample> samples;  // at k sample_interval, k = 1, 2, .., before the exit

  bool complete() const { return outcome == Outcome::left || outcome == Outcome::pinned; }
};

// Input of a passage. The parameters must outlive it.
struct PassageTask {
  const Parameters* parameters;
  Bristle<double> bristle;
  Equilibrium start;  // initial position at rest, at the azimuth theta_0 of the bristle
  IntegratorOptions integrator;
  double sample_interval = 0;  // time between Passage::samples; 0: no samples. No other value depends on it
};

// Computes the passages of the tasks, in the order of the tasks. The result of a task does not depend on the
// other tasks.
using PassageRunner = std::function<std::vector<Passage>(const std::vector<PassageTask>&)>;

enum class Engine {
  fast,      // src/bristle/simd: one bristle in each SIMD lane
  reference  // run_passage(): one bristle after the other, by Boost.Odeint
};
template <>
inline Words words<Engine>() {
  static constexpr const char* list[] = {"fast", "reference"};
  return list;
}

// Called with the time xi and the state at the start, after each step and at the exit.
using Observer = std::function<void(double xi, const OdeState&)>;

// Integrates Eqs. (13, 17, 18) with Boost.Odeint from rest until the slip xi - (x - x(0)) reaches L_x (Eq.
// A2). This is the reference for the SIMD engine. A numerical failure is an Outcome, not an exception.
Passage run_passage(const PassageTask& task, const Observer& observe = {});

// Computes the outcome, gamma_1..3 and the energy residual of a passage that reached its exit, from
// contact_time and end, and completes its path.
void evaluate_exit(const PassageTask& task, Passage& passage);

}  // namespace bristle
