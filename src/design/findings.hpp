#pragma once

#include "design/trials.hpp"
#include "results/dataset.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bristle::design {

// A brush that was computed again beside the trials of the search.
struct Brush {
  Trial trial;
  std::optional<Verification> verification;  // none without tolerances

  const Outcome& outcome() const { return verification ? static_cast<const Outcome&>(*verification) : trial; }
};

// By how much the objective of a brush is better than the objective of the start.
struct Gain {
  Quantity difference;  // positive: better; the error is the sum of the errors of both
  double point_error;   // the part of the error that comes from the points, not from the number of deviations
  double scale;         // amount of the objective's value at the start

  Quantity relative() const { return {difference.value / scale, difference.error / scale}; }
  bool within_errors() const { return !(difference.value > point_error); }
};

// A constraint that the recommended brush violates, as it is made or nominally.
struct Broken {
  std::size_t number;   // of the constraint in the design
  double value, limit;  // the value that is farthest beyond the limit
  std::size_t brushes;  // number of verified brushes beyond the limit; 0: only the trial is
};

// What a search found.
struct Findings {
  std::vector<Trial> trials;
  std::vector<std::size_t> optima;  // trials at which the local searches ended, the best first
  std::vector<std::size_t> chosen;  // trials: the recommended one first, then other local optima
  std::size_t best = 0;             // the best trial: with the least violation, if none meets the constraints
  // The experiment's own values, if it has one of each variable: the last trial if they are within the bounds
  // of the variables, and otherwise computed only for the comparison.
  std::optional<std::size_t> start_trial;
  std::optional<Trial> start_outside;
  std::optional<Trial> made;      // the recommended trial, rounded to what can be made; none without steps
  std::vector<Profile> profiles;  // profiles of the recommended trial, by quantity
  // Verifications of the recommended trial and of the start; none without tolerances.
  std::optional<Verification> verification, start_verification;
  std::optional<Brush> not_worth;       // the brush that would be recommended, were the start not as good
  std::size_t not_worth_trial = 0;      // its number
  std::optional<SobolIndices> indices;  // indices of the objective; none without tolerances
};

// Returns the trial that is recommended: the rounded one, if there is one.
const Trial& recommended(const Findings& found);

// Returns the experiment's own values as computed; null if it lacks one of a variable.
const Trial* start_of(const Findings& found);

constexpr const char* kRecommended = "recommended";  // name of the recommended trial before it is rounded

// A trial in the comparison of the recommended one with others.
struct Compared {
  std::string name, heading;
  const Trial* trial;
};

// Returns what an engineer compares: the start, the recommended trial, this trial as it can be made, and the
// brush that would be recommended were the start not as good. The pointers are into `found`.
std::vector<Compared> compared(const Findings& found);

// Returns true if the objectives of two trials differ by more than the sum of the errors of their points. The
// deviations are the same for all trials: that they are few makes each value uncertain, not the difference.
bool differ(const Trial& a, const Trial& b);

// Returns the gain of a brush over the start: from the verifications of both, or from the trials if there are
// none. None without a start.
std::optional<Gain> gain_of(const Design& design, const Findings& found, const Outcome& brush);

// Returns true if a gain exceeds its point error and the design's least gain.
bool is_worth(const Design& design, const Gain& gain);

// Returns the verification of the recommended trial, or the trial if there is none.
const Outcome& recommended_outcome(const Findings& found);

// Returns true if brushes made like the start violate a constraint, and none made like the recommended one
// do.
bool start_alone_violates(const Findings& found);

// Returns the constraints that the recommended trial violates, or some brush of its verification.
std::vector<Broken> broken_constraints(const Design& design, const Findings& found);

// Returns true if a trial that meets the constraints differs from the start, see differ().
bool variables_matter(const Findings& found, const Trial& start);

// Returns the column of a variable of the design, or of another number that a sweep can vary.
results::Column column_of(const std::string& quantity);

// Returns what texts call a quantity: its key without the unit.
std::string label_of(const std::string& quantity);

}  // namespace bristle::design
