#include "results/phases.hpp"

#include "ensemble/phase.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>

namespace bristle::results {

std::string phase_text(const std::vector<double>& phases) {
  const auto count = [&](BrushPhase phase) { return std::ranges::count(phases, double(phase)); };
  const struct {
    BrushPhase phase;
    const char* what;
  } rows[] = {{BrushPhase::contact, "in contact (tips stay on the slab)"},
              {BrushPhase::bouncing, "bouncing (tips are off the slab for more than half of the time)"},
              {BrushPhase::mixed, "between the two"}};
  std::vector<std::string> parts;
  for (const auto& row : rows)
    if (const auto points = count(row.phase)) parts.push_back(fmt::format("{} {}", points, row.what));
  return parts.empty() ? "" : fmt::format("phases: {}\n", fmt::join(parts, ", "));
}

}  // namespace bristle::results
