#pragma once

#include "dynamics/components.hpp"
#include "model/bristle.hpp"
#include "model/equilibrium.hpp"

#include <functional>
#include <vector>

namespace bristle {

// How a passage ended. Data, not an error.
enum class Outcome {
  left,        // over the vertical, or never there, and out at the trailing edge
  pinned,      // out at the trailing edge, but held upright at the axis by the repulsion
  step_limit,  // the cap on derivative evaluations was reached
  not_finite   // no finite step could be made
};

enum class Method {
  automatic,
  explicit_only,
  implicit_only
};

struct IntegratorOptions {
  double rtol = 1e-6;
  double atol = 1e-8;
  Method method = Method::automatic;  // automatic: explicit, then implicit once the bristle is stiff
  long max_evaluations = 2'000'000;   // of derivative(), rejected steps included
};

// Integrals along a passage up to an instant.
struct PathSample {
  double normal, friction_x, friction_y;  // of F_n, F_fx, F_fy, as Component has them
};

// One bristle from leading to trailing edge. Times and integrals dimensionless, see Component.
struct Passage {
  Outcome outcome = Outcome::not_finite;
  double theta_0 = 0;                            // rad
  double contact_time = 0;                       // T = Delta xi
  OdeState end{};                                // state and integrals at the exit
  double gamma_1 = 0, gamma_2 = 0, gamma_3 = 0;  // this bristle's ratios in Eqs. (24-26)
  double energy_residual = 0;                    // |E(T) - E(0) - work| over the energy dissipated
  long steps = 0, evaluations = 0;
  int reflections = 0;    // at the pole, s = s_min
  bool implicit = false;  // the implicit method finished it
  std::vector<PathSample>
      samples;  // at the multiples of the task's interval before the exit, from the first on

  bool complete() const { return outcome == Outcome::left || outcome == Outcome::pinned; }
};

// A passage to be computed. The parameters must outlive it.
struct PassageTask {
  const Parameters* parameters;
  Bristle<double> bristle;
  Equilibrium start;  // at rest in it, at the bristle's theta_0
  IntegratorOptions integrator;
  double sample_interval = 0;  // of Passage::samples; 0: none. Nothing else depends on it
};

// Computes passages, in the order of the tasks. The result of a task does not depend on the others.
using PassageRunner = std::function<std::vector<Passage>(const std::vector<PassageTask>&)>;

enum class Engine {
  fast,      // src/simd: one bristle per SIMD lane
  reference  // run_passage(): one bristle after the other, by Boost.Odeint
};

// Called with time and state at the start, after each step and at the exit.
using Observer = std::function<void(double xi, const OdeState&)>;

// Integrates Eqs. (13, 17, 18) from rest until the slip xi - (x - x(0)) reaches L_x (Eq. A2), by
// Boost.Odeint: the reference that the lanes are held against. Never throws for a numerical outcome.
Passage run_passage(const PassageTask& task, const Observer& observe = {});

}  // namespace bristle
