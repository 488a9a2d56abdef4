#pragma once

#include "simd/runner.hpp"
#include "ensemble/orientation.hpp"
#include "ensemble/quadrature.hpp"

#include <array>
#include <optional>
#include <vector>

namespace bristle {

// What is averaged over theta_0. Dimensionless; forces per N_c0.
enum Observable {
  N_C_RATIO,  // <T>/L_x
  R_N,        // <int F_n dxi>/L_x
  R_X,        // <int F_fx dxi>/L_x
  R_Y,
  GAMMA_1,  // Eqs. (24-26)
  GAMMA_2,
  GAMMA_3,
  PINNED_FRACTION,
  PINNED_R_N,  // the pinned bristles' part of R_n and R_x
  PINNED_R_X,
  ENERGY_RESIDUAL,
  OBSERVABLES
};
using ObservableArray = std::array<double, OBSERVABLES>;

// Bristles, slab and how to compute them: everything a mean over theta_0 depends on but the gap.
struct Setup {
  Parameters parameters;
  Orientation orientation;
  IntegratorOptions integrator;
};

struct Ensemble {
  double z_0 = 0;
  ObservableArray mean{}, error{};  // error: the quadrature's estimate
  bool converged = true;            // error within rtol
  long passages = 0;
  long incomplete = 0;            // passages that reached no exit; > 0: mean and error mean nothing
  double incomplete_theta_0 = 0;  // the first of them, rad
  std::vector<double> jumps;      // theta_0 at which the outcome changes, rad
};

// The mean over theta_0, by quadrature or over a list, of single passages at the gap z_0 (model:
// docs/model.md, section "The slab"). Every passage counts for all that is asked of it later. A numerical
// failure is reported in the result. The setup must outlive it.
class EnsembleMean {
 public:
  EnsembleMean(const Setup& setup, double z_0, PassageRunner run);
  EnsembleMean(const EnsembleMean&) = delete;
  EnsembleMean& operator=(const EnsembleMean&) = delete;

  // R_n only, as accurate as it takes to tell it from R_n_target: a quarter of their distance, and at most
  // 4 orientation.rtol. Far from the target this is a rough mean of few bristles.
  const Ensemble& against(double R_n_target);
  // R_n to half of orientation.rtol: what a root-finder needs near the target.
  const Ensemble& near_target();
  // R_n, R_x, N_c and gamma_1..3 to orientation.rtol.
  const Ensemble& full();

  // All passages computed, in the order asked.
  const std::vector<Passage>& passages() const { return passages_; }

 private:
  using Goal = QuadratureGoal<OBSERVABLES>;

  std::vector<Sample<OBSERVABLES>> samples(const std::vector<double>& theta_0);
  std::vector<Passage> run(const std::vector<double>& theta_0);
  const Ensemble& refine(const Goal& goal);
  void average_list();
  Goal goal() const;

  const Setup& setup_;
  PassageRunner run_;
  Equilibrium start_;
  bool half_circle_;
  Ensemble out_;
  std::vector<Passage> passages_;
  std::optional<Quadrature<OBSERVABLES>> quadrature_;  // none for a list
};

// What one passage contributes to the means of a slab of this length.
ObservableArray observables(const Passage& passage, double L_x);

// R_rigid of Eqs. (22, 23) per N_c0, at the normal load R_n/N_c0. Dimensionless.
double rigid_friction(const Parameters& p, double R_n);

}  // namespace bristle
