#pragma once

#include "bristle/ensemble/observables.hpp"
#include "bristle/ensemble/orientation.hpp"
#include "bristle/ensemble/quadrature.hpp"
#include "bristle/ensemble/scatter.hpp"
#include "bristle/simd/runner.hpp"

#include <optional>
#include <vector>

namespace bristle {

// All inputs of an ensemble mean except the gap.
struct Setup {
  Parameters parameters;
  Orientation orientation;
  IntegratorOptions integrator;
  Scatter scatter{};  // how the bristles differ from the parameters
  // Limit on the evaluations of the equations in means and load searches of one point.
  long max_evaluations_per_point = 2'000'000'000;
};

struct Ensemble {
  double z_0 = 0;
  // error is the estimate of the quadrature (0 for a list), to which with_integrator_error() adds
  // integrator_error. Before that, integrator_error is 0.
  ObservableArray mean{}, error{}, integrator_error{};
  bool converged = true;  // error of the quadrature within rtol
  long passages = 0;
  long incomplete = 0;            // passages that reached no exit; if > 0, mean and error are invalid
  double incomplete_theta_0 = 0;  // azimuth of the first incomplete passage, rad
  std::vector<double> jumps;      // theta_0 at which the outcome changes, rad
};

// A passage and its share of the ensemble mean; the shares of all passages add up to 1.
struct WeightedPassage {
  const Passage* passage;
  double weight;
};

// Computes the ensemble mean, by quadrature or over a list, of single passages at the gap z_0 (docs/model.md,
// section "The slab"). Each call refines the result of the calls before it and reuses all passages; after
// full() nothing is refined any more. A numerical failure is reported in the result. The setup must outlive
// the object.
class EnsembleMean {
 public:
  // Prepares the mean at the gap z_0. start is the position of the bristles at the leading edge, at this gap.
  EnsembleMean(const Setup& setup, double z_0, const Equilibrium& start, PassageRunner run);
  EnsembleMean(const Setup& setup, double z_0, PassageRunner run)
      : EnsembleMean(setup, z_0, InitialStates(setup.parameters).at(z_0), std::move(run)) {}
  EnsembleMean(const EnsembleMean&) = delete;
  EnsembleMean& operator=(const EnsembleMean&) = delete;

  // Computes R_n with an error of at most a quarter of its distance from R_n_target, or 4 orientation.rtol if
  // that is larger. Far from the target this takes few bristles.
  const Ensemble& rough_load(double R_n_target);
  // Computes R_n, for a root-finder, with an error of at most a quarter of its distance from R_n_target, or
  // half of orientation.rtol if that is larger.
  const Ensemble& precise_load(double R_n_target);
  // Returns the result so far, without refining it.
  const Ensemble& known() const { return checked_ ? *checked_ : out_; }
  // Computes R_n, R_x, N_c and gamma_1..3 to orientation.rtol.
  const Ensemble& full();
  // Ends the quadrature where it is, as not converged, after the runner has thrown; full() then returns these
  // values. Does nothing and returns false unless outcomes alternate: otherwise the errors are too small
  // before the mean is complete.
  bool interrupt();
  // Computes the values of full(), with errors that include an estimate of the integrator's error
  // (integrator_error.hpp).
  const Ensemble& with_integrator_error();

  struct Difference {
    ObservableArray mean{}, error{};
  };
  // Returns the mean at the other gap minus this mean, as known so far.
  Difference difference_to(const EnsembleMean& other) const;

  // Returns the number of computed passages, including the passages that with_integrator_error() repeated.
  long count() const { return checked_ ? checked_->passages : out_.passages; }
  // Returns the passages of the means, in the order of computation.
  const std::vector<Passage>& passages() const { return passages_; }

 private:
  PassageTask task(double theta_0) const;
  // Returns the weight of a passage in the means, per rad of theta_0.
  double weight(double theta_0) const;
  std::vector<WeightedPassage> weighted_passages() const;
  std::vector<Sample> samples(const std::vector<double>& theta_0);
  std::vector<Passage> run(const std::vector<double>& theta_0);
  double hidden_fraction() const;
  // Adds the effect of bristles whose outcome falls between two nodes to the errors of the pinned fraction
  // and of the means over pinned and unpinned bristles.
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

// Returns R_rigid of Eqs. (22, 23) per N_c0, for the normal load R_n per N_c0. Dimensionless.
double rigid_friction(const Parameters& p, double R_n);

}  // namespace bristle
