#pragma once

#include "bristle/ensemble/point.hpp"

namespace bristle {

// Quantities derived from the values of a point. All errors add linearly.

// Returns the share of an observable that the pinned bristles carry. Dimensionless.
Quantity pinned_share(const PointResult& p, Observable k);

// Returns the mean of an observable over the bristles that are not pinned. Dimensionless.
Quantity unpinned_mean(const PointResult& p, Observable k);

// Returns the friction force of the bristles that are not pinned over the friction force of rigid bristles
// under the whole load.
Quantity unpinned_friction(const PointResult& p);

// Returns R_x/R_n, Eq. (19). Dimensionless.
Quantity friction_coefficient(const PointResult& p);

// Returns the force against the motion, R_x and the work of entering bristles E_0/L_x, per N_c0.
// Dimensionless.
Quantity drag(const PointResult& p);

// Returns the number of impacts on the slab per time of contact. Dimensionless.
Quantity impact_rate(const PointResult& p);

// Returns the magnitude of the in-plane friction force over the friction force of rigid bristles, from Eqs.
// (20, 21). Dimensionless.
Quantity friction_magnitude(const PointResult& p);

// Returns the angle from the direction opposite to the motion to the friction force, in degrees: from -180 to
// 180.
Quantity friction_direction(const PointResult& p);

}  // namespace bristle
