#pragma once

#include "bristle/ensemble/point.hpp"
#include "json/json.hpp"

namespace bristle::page {

// Returns the recorded trajectories of a point as the player draws them: of each the columns of some rows.
Json passages_of(const Recorded& recorded, const PointResult& point);

}  // namespace bristle::page
