#pragma once

#include "design/trials.hpp"
#include "results/dataset.hpp"

#include <optional>
#include <string>
#include <vector>

namespace bristle::design {

// What a search found.
struct Findings {
  std::vector<Trial> trials;
  std::vector<std::size_t> optima;  // trials at which the searches of one objective ended, the best first
  std::vector<std::size_t> chosen;  // trials: the recommended one first, then other local optima
  std::vector<std::size_t> front;   // trials that no other surpasses
  std::size_t nearest_miss = 0;     // trial with the least violation, if none meets the constraints
  // The experiment's own values, if it has one of each variable: the last trial if they are within the bounds
  // of the variables, and otherwise computed only for the comparison.
  std::optional<std::size_t> start_trial;
  std::optional<Trial> start_outside;
  std::optional<Trial> made;      // the recommended trial, rounded to what can be made; none without steps
  std::vector<Profile> profiles;  // profiles of the recommended trial, by quantity
  std::optional<Verification> verification;  // verification of the recommended trial; none without tolerances
  std::vector<SobolIndices> indices;         // indices of each objective; empty without tolerances
  std::optional<Trial> second;               // the recommended trial with the second model
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

// Returns what an engineer compares: the start, the recommended trial, the same as it can be made, and the
// best trial of the front for each of several objectives. The pointers are into `found`.
std::vector<Compared> compared(const Trials& trials, const Findings& found);

// Returns true if some objective of two trials differs by more than the sum of the errors of its points. The
// deviations are the same for all trials: that they are few makes each value uncertain, not the difference.
bool differ(const Trial& a, const Trial& b);

// Returns true if some objective of two trials differs by more than the sum of its errors.
bool differ_beyond_deviations(const Trial& a, const Trial& b);

// Returns true if a trial that meets the constraints differs from the start, see differ().
bool variables_matter(const Findings& found, const Trial& start);

// Returns the best of the trials with these numbers: among those that equal the best in an objective within
// the sum of the errors, the next objective decides. The list must not be empty.
std::size_t best_within_errors(const Design& design, const std::vector<Trial>& trials,
                               std::vector<std::size_t> list);

// Returns the column of a variable of the design, or of another number that a sweep can vary.
results::Column column_of(const std::string& quantity);

}  // namespace bristle::design
