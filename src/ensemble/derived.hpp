#pragma once

#include "ensemble/point.hpp"

namespace bristle {

// A quantity derived from the values of a point, with its error. load_error is the part of the error due to
// the load search; NaN if unknown. All errors add linearly.
struct Derived {
  double value, error, load_error;
};

// Share of an observable that the pinned bristles carry. Dimensionless.
Derived pinned_share(const PointResult& p, Observable k);

// Mean of an observable over the bristles that are not pinned. Dimensionless.
Derived unpinned_mean(const PointResult& p, Observable k);

// Friction force of the bristles that are not pinned over that of rigid bristles under the whole load.
Derived unpinned_friction(const PointResult& p);

// R_x/R_n, Eq. (19). Dimensionless.
Derived friction_coefficient(const PointResult& p);

// Impacts on the slab per time of contact. Dimensionless.
Derived impact_rate(const PointResult& p);

// Magnitude of the in-plane friction force over that of rigid bristles, from Eqs. (20, 21). Dimensionless.
Derived friction_magnitude(const PointResult& p);

// Angle from the direction opposite to the motion to the friction force, in degrees: from -180 to 180.
Derived friction_direction(const PointResult& p);

}  // namespace bristle
