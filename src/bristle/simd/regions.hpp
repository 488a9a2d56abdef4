#pragma once

#include "bristle/simd/group.hpp"

// Which terms of a step are implicit, and which steps are events, far from the pole, near it and without one.
namespace bristle::HWY_NAMESPACE {

inline Lanes::Mask none() { return Lanes(0.0) < Lanes(0.0); }

// Far from the pole: its neighbourhood is an event, as a step could cross it.
struct FarFromPole {
  static constexpr bool kImplicitAzimuthDamper = true, kImplicitPolarDamper = false,
                        kImplicitRodDampers = false;
  static Lanes::Mask pole_event(const Group& g) {
    return (in_plane_distance_squared(g.y_new) < Lanes(g.s_handover * g.s_handover)) | passes_pole(g);
  }
  static Lanes::Mask leaves_pole(const Group&) { return none(); }

 private:
  // Returns true if the tip approached the pole, now recedes, and its straight path would have come within
  // s_handover.
  static Lanes::Mask passes_pole(const Group& g) {
    using namespace component;
    const Lanes angular_momentum = g.y[X] * g.y[VY] - g.y[Y] * g.y[VX];
    const Lanes speed2 = g.y[VX] * g.y[VX] + g.y[VY] * g.y[VY];
    const Lanes reach = g.s_handover * g.s_handover;
    return (radial_product(g.y) < Lanes(0.0)) & (Lanes(0.0) < radial_product(g.y_new)) &
           (Lanes(angular_momentum * angular_momentum) < Lanes(reach * speed2));
  }
};

// Returns true if a step may reach s_min. The tip must approach the singular place (the pole, or a rod's
// base) at the start of the step. Its path is the cubic through positions and velocities at both ends, which
// lies within the hull of four control points; if these are all farther away than s_min in one direction, so
// is the path. Dimensions: 2 in the plane, 3 in space.
template <int Dimensions>
inline Lanes::Mask may_reach_s_min(const Group& g) {
  using namespace component;
  Lanes points[4][Dimensions], direction[Dimensions], length2 = 0.0, product = 0.0;
  for (int i = 0; i < Dimensions; ++i) {
    points[0][i] = g.y[X + i];
    points[1][i] = g.y[X + i] + g.h * Lanes(g.y[VX + i] * Lanes(1.0 / 3));
    points[2][i] = g.y_new[X + i] - g.h * Lanes(g.y_new[VX + i] * Lanes(1.0 / 3));
    points[3][i] = g.y_new[X + i];
    direction[i] = (points[0][i] + points[1][i]) + (points[2][i] + points[3][i]);
    length2 += direction[i] * direction[i];
    product += g.y[X + i] * g.y[VX + i];
  }
  const Lanes reach = 1.001 * g.s_min, limit = Lanes(reach * reach) * length2;
  Lanes::Mask farther = !none();
  for (const auto& point : points) {
    Lanes along = 0.0;
    for (int i = 0; i < Dimensions; ++i) along += direction[i] * point[i];
    farther = farther & (Lanes(0.0) < along) & (limit < Lanes(along * along));
  }
  return (product < Lanes(0.0)) & !farther;
}

struct NearPole {
  static constexpr bool kImplicitAzimuthDamper = true, kImplicitPolarDamper = true,
                        kImplicitRodDampers = false;
  static Lanes::Mask pole_event(const Group& g) { return may_reach_s_min<2>(g); }
  static Lanes::Mask leaves_pole(const Group& g) {
    return Lanes(g.s_handover * g.s_handover) < in_plane_distance_squared(g.y_new);
  }
};

// Of a rod: only its base is singular.
struct WithoutPole {
  static constexpr bool kImplicitAzimuthDamper = false, kImplicitPolarDamper = false,
                        kImplicitRodDampers = true;
  static Lanes::Mask pole_event(const Group& g) { return may_reach_s_min<3>(g); }
  static Lanes::Mask leaves_pole(const Group&) { return none(); }
};

}  // namespace bristle::HWY_NAMESPACE
