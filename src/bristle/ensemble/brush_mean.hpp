#pragma once

#include "bristle/ensemble/ensemble.hpp"
#include "bristle/ensemble/scatter.hpp"

#include <deque>

namespace bristle {

// The bristles that stand for a brush, with equal weights: the nominal one, or the bristles of
// representative_deviations(). The setup must outlive the object.
class Brush {
 public:
  struct Member {
    Setup setup;  // in units of this bristle
    double length;
    ObservableArray unit;  // units_of(), in units of the nominal bristle
    InitialStates starts;

    Member(const Setup& nominal, const DeviatingBristle& bristle);
    Member(const Member&) = delete;
    Member& operator=(const Member&) = delete;
  };

  explicit Brush(const Setup& setup);

  const std::vector<Deviations>& deviations() const { return deviations_; }
  std::deque<Member>& members() { return members_; }
  // Returns the gap at which the first bristle meets the slab, in units of the nominal r0.
  double first_contact() const;
  // Returns how the bristles yield on the way down to the ground, if all do so in the same way.
  Start start();

 private:
  std::vector<Deviations> deviations_;
  std::deque<Member> members_;
};

// Computes the mean over the bristles of a brush at the gap z_0 (in units of the nominal r0): the mean of the
// EnsembleMean of each member, in units of the nominal bristle. Its functions do what the functions of
// EnsembleMean do, but interrupt() does nothing if the brush has scatter; without scatter the numbers are the
// same, bit for bit. The errors of the quadrature add up over the members as if they were all of one sign;
// with_integrator_error() adds scatter_error(). The brush must outlive the object.
class BrushMean {
 public:
  BrushMean(Brush& brush, double z_0, PassageRunner run);
  BrushMean(const BrushMean&) = delete;
  BrushMean& operator=(const BrushMean&) = delete;

  const Ensemble& rough_load(double R_n_target);
  const Ensemble& precise_load(double R_n_target);
  const Ensemble& known() const;
  const Ensemble& full();
  bool interrupt();
  const Ensemble& with_integrator_error();
  EnsembleMean::Difference difference_to(const BrushMean& other) const;
  long count() const;
  // Returns the passages of the nominal bristle. The brush must have no scatter.
  const std::vector<Passage>& passages() const { return parts_.front().mean.passages(); }

 private:
  struct Part {
    Part(Brush::Member& member, double z_0, const PassageRunner& run);

    const Brush::Member& member;
    const PassageRunner* run;  // where this part's passages are computed at the moment
    EnsembleMean mean;
  };

  bool single() const { return parts_.size() == 1; }
  // Calls refine(part) for each part, together, and combines the results.
  template <class Refine>
  const Ensemble& refine(Refine refine);
  const Ensemble& combine();
  // Refines R_n by one of the functions of EnsembleMean until its error is at most `rtol` of the target, or a
  // quarter of the distance from it.
  const Ensemble& load(const Ensemble& (EnsembleMean::*refine_load)(double), double R_n_target, double rtol);

  const Brush& brush_;
  double rtol_;
  PassageRunner run_;
  std::deque<Part> parts_;
  Ensemble out_;
};

}  // namespace bristle
