#include "ensemble/load_path.hpp"

#include <algorithm>
#include <cmath>

namespace bristle {

// A load may be that of the target if its distance is below this multiple of its error; the errors of means
// that are decided are smaller.
constexpr double kMaybe = 3;

GapLoad LoadsOnPath::at(double z_0, Accuracy accuracy) {
  const Load load = curve_(z_0, accuracy);
  if (!std::isfinite(load.R_n)) throw NotComputable{};
  const double sign = search.path == LoadPath::loading ? 1 : -1;
  computed_.push_back({z_0, load, sign * (load.R_n - search.target)});
  return computed_.back();
}

GapLoad LoadsOnPath::one_step_beyond(double z_0, Accuracy accuracy) {
  return at(std::clamp(beyond(z_0, search.step), search.ground, search.first_contact), accuracy);
}

bool LoadsOnPath::near_target(const GapLoad& gap) {
  if (std::abs(gap.excess) > allowed() + kMaybe * gap.load.error) return false;
  const GapLoad reported = at(gap.z_0, Accuracy::reported);
  return std::abs(reported.excess) <= std::max(allowed(), kDistinct * reported.load.error);
}

}  // namespace bristle
