#pragma once

#include "bristle/ensemble/observables.hpp"
#include "bristle/ensemble/orientation.hpp"
#include "bristle/ensemble/quadrature.hpp"
#include "bristle/simd/runner.hpp"

#include <optional>
#include <vector>

namespace bristle {

// All inputs of an ensemble mean except the gap.
struct Setup {
  Parameters parameters;
  Orientation orientation;
  IntegratorOptions integrator;
  // Limit on the evaluations of the equations in means and load searches of one point.
  long max_evaluations_per_point = 2'000'000'000;
};

struct Ensemble {
  double z_0 = 0;
  // error: estimate of the quadrature (0 for a list). with_integrator_error() adds integrator_error to it,
  // which is 0 otherwise.
  ObservableArray mean{}, error{}, integrator_error{};
  bool converged = true;  // error of the quadrature within rtol
  long passages = 0;
  long incomplete = 0;            // passages that reached no exit; if > 0, mean and error are invalid
  double incomplete_theta_0 = 0;  // azimuth of the first of them, rad
  std::vector<double> jumps;      // theta_0 at which the outcome changes, rad
};

// A passage and its share of the ensemble mean; the shares of all passages add up to 1.
struct WeightedPassage {
  const Passage* passage;
  double weight;
};

// Ensemble mean, by quadrature or over a list, of single passages at the gap z_0 (docs/model.md, section "The
// slab"). Each call refines the result of the calls before it and reuses all passages; after full() nothing
// is refined any more. A numerical failure is reported in the result. The setup must outlive the object.
class EnsembleMean {
 public:
  // start: of the bristles, at this gap.
  EnsembleMean(const Setup& setup, double z_0, const Equilibrium& start, PassageRunner run);
  EnsembleMean(const Setup& setup, double z_0, PassageRunner run)
      : EnsembleMean(setup, z_0, InitialStates(setup.parameters).at(z_0), std::move(run)) {}
  EnsembleMean(const EnsembleMean&) = delete;
  EnsembleMean& operator=(const EnsembleMean&) = delete;

  // R_n with an error of at most a quarter of its distance from R_n_target, or 4 orientation.rtol if that is
  // larger. Far from the target this takes few bristles.
  const Ensemble& rough_load(double R_n_target);
  // R_n with an error of at most a quarter of its distance from R_n_target, or half of orientation.rtol if
  // that is larger, for a root-finder.
  const Ensemble& precise_load(double R_n_target);
  // The result of the calls before.
  const Ensemble& known() const { return checked_ ? *checked_ : out_; }
  // R_n, R_x, N_c and gamma_1..3 to orientation.rtol.
  const Ensemble& full();
  // Ends the quadrature as it is, not converged, after the runner has thrown: full() returns these values.
  // Returns false, and changes nothing, unless outcomes alternate: other errors are too small before the mean
  // is complete.
  bool interrupt();
  // The values of full(); errors include an estimate of the error of the integrator, see
  // integrator_error.hpp.
  const Ensemble& with_integrator_error();

  struct Difference {
    ObservableArray mean{}, error{};
  };
  // The mean at the other gap minus this one, as known so far.
  Difference difference_to(const EnsembleMean& other) const;

  // Number of computed passages, with those that with_integrator_error() repeated.
  long count() const { return checked_ ? checked_->passages : out_.passages; }
  // The passages of the means, in the order of computation.
  const std::vector<Passage>& passages() const { return passages_; }

 private:
  PassageTask task(double theta_0) const;
  // Weight of a passage in the means, per rad of theta_0.
  double weight(double theta_0) const;
  std::vector<WeightedPassage> weighted_passages() const;
  std::vector<Sample> samples(const std::vector<double>& theta_0);
  std::vector<Passage> run(const std::vector<double>& theta_0);
  double hidden_fraction() const;
  // Adds to the errors of what is averaged over the pinned or the other bristles what the nodes may not have
  // seen.
  void add_hidden_errors();
  const Ensemble& refine(const QuadratureGoal& goal);
  void take(const QuadratureResult& result);
  void average_list();
  QuadratureGoal goal() const;

  const Setup& setup_;
  PassageRunner run_;
  Equilibrium start_;
  Density density_;
  bool half_circle_;
  Ensemble out_;
  std::vector<Passage> passages_;
  bool full_ = false;                     // whether full() has been called
  std::optional<Ensemble> checked_;       // with_integrator_error()
  std::optional<Quadrature> quadrature_;  // none for a list
};

// R_rigid of Eqs. (22, 23) per N_c0, for the normal load R_n per N_c0. Dimensionless.
double rigid_friction(const Parameters& p, double R_n);

}  // namespace bristle
