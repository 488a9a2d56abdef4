#include "bristle/ensemble/load_path.hpp"

#include <algorithm>
#include <cmath>

namespace bristle {

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

}  // namespace bristle
