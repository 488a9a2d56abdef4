#pragma once

#include "ensemble/point.hpp"

namespace bristle {

// A quantity that follows from the values of a point, with its error and the part of it that the load search
// causes. All errors add linearly.
struct Derived {
  double value, error, load_error;
};

// The part of a total that pinned bristles carry: part over total. Dimensionless.
Derived share_of(const PointResult& p, Observable part, Observable total);

// R_x/R_n, Eq. (19). Dimensionless.
Derived friction_coefficient(const PointResult& p);

// Magnitude of the friction force in the plane, over that of rigid bristles, from Eqs. (20, 21); and the
// direction of the force that opposes the motion, measured from the direction of motion, in degrees.
Derived friction_magnitude(const PointResult& p);
Derived friction_direction(const PointResult& p);

}  // namespace bristle
