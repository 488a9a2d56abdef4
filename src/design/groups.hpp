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
  std::size_t nearest_miss = 0;     // the least violation, where no trial meets the constraints
  std::vector<Profile> profiles;    // beside the recommended trial, by quantity
  std::optional<Verification> verification;  // of the recommended trial; none without tolerances
  std::vector<SobolIndices> indices;         // by objective; empty without tolerances
  std::optional<Trial> second;               // the recommended trial with the second model
};

// The groups /trials, /front, /best, /profiles, /verification, /indices and /second of the result.
std::vector<results::Dataset> groups_of(const Experiment& experiment, const Trials& trials,
                                        const Findings& found);

// The findings in words.
std::string text_of(const Experiment& experiment, const Findings& found);

}  // namespace bristle::design
