#pragma once

#include "design/trials.hpp"
#include "results/dataset.hpp"

#include <optional>

namespace bristle::design {

// What a search found.
struct Findings {
  std::vector<Trial> trials;
  std::vector<std::size_t> optima;  // trials at which the searches of one objective ended, the best first
  std::vector<std::size_t> chosen;  // trials: the recommended one first, then other local optima
  std::vector<std::size_t> front;   // trials that no other surpasses
  std::size_t nearest_miss = 0;     // trial with the least violation, if none meets the constraints
  std::optional<Trial> start;       // the experiment's own values, if it has one of each variable
  std::optional<Trial> made;        // the recommended trial, rounded to what can be made; none without steps
  std::vector<Profile> profiles;    // profiles of the recommended trial, by quantity
  std::optional<Verification> verification;  // verification of the recommended trial; none without tolerances
  std::vector<SobolIndices> indices;         // indices of each objective; empty without tolerances
  std::optional<Trial> second;               // the recommended trial with the second model
};

// Returns the trial that is recommended: the rounded one, if there is one.
const Trial& recommended(const Findings& found);

// Returns the groups /trials, /front, /best, /comparison, /profiles, /verification, /indices and /second of
// the result.
std::vector<results::Dataset> groups_of(const Trials& trials, const Findings& found);

// Returns the findings in words.
std::string text_of(const Trials& trials, const Findings& found);

}  // namespace bristle::design
