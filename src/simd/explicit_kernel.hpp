#pragma once

#include "simd/group.hpp"

namespace bristle::HWY_NAMESPACE {

// Steps by an explicit embedded pair. The stages advance
// only the state, as no force depends on the integrals.
template <class Tableau>
class ExplicitStep {
 public:
  static constexpr double kExponent = Tableau::exponent;

  static void refresh(Group& g) { evaluate(g.bristle, g.y.data(), g.slope); }

  // Computes y_new and slope_new; returns the largest ratio of error to tolerance.
  static Lanes attempt(Group& g) {
    Slopes<S> k;
    k[0] = g.slope;
    stages(g, k, std::make_index_sequence<S>());
    for (int c = 0; c < COMPONENTS; ++c)
      g.y_new[c] = g.y[c] + g.h * weighted_sum<S>(k, c, [](int j) { return Tableau::b[j]; });
    evaluate(g.bristle, g.y_new.data(), g.slope_new);
    ErrorNorm norm(g);
    for (int c = 0; c < COMPONENTS; ++c) {
      const Lanes stages_error = weighted_sum<S>(k, c, [](int j) { return Tableau::error[j]; });
      norm.add(c, g.h * Lanes(stages_error + g.slope_new[c] * Lanes(Tableau::error[S])));
    }
    return norm.value();
  }

  // Near the pole the equations are stiff, and an explicit step could cross it.
  static Lanes::Mask pole_event(const Group& g) {
    return (in_plane_distance_squared(g.y_new) < Lanes(g.s_handover * g.s_handover)) | passes_pole(g);
  }
  static Lanes::Mask leaves_pole(const Group&) { return Lanes(0.0) < Lanes(0.0); }

 private:
  static constexpr int S = Tableau::stages;

  template <std::size_t... I>
  static HWY_INLINE void stages(const Group& g, Slopes<S>& k, std::index_sequence<I...>) {
    (stage<int(I)>(g, k), ...);
  }
  template <int I>
  static HWY_INLINE void stage(const Group& g, Slopes<S>& k) {
    if constexpr (I > 0) {
      std::array<Lanes, kState> at;
      for (int c = 0; c < kState; ++c)
        at[c] = g.y[c] + g.h * weighted_sum<I>(k, c, [](int j) { return Tableau::a[I][j]; });
      evaluate(g.bristle, at.data(), k[I]);
    }
  }

  // The tip approached the pole, now recedes, and its straight path would have come within s_handover.
  static Lanes::Mask passes_pole(const Group& g) {
    const Lanes angular_momentum = g.y[X] * g.y[VY] - g.y[Y] * g.y[VX];
    const Lanes speed2 = g.y[VX] * g.y[VX] + g.y[VY] * g.y[VY];
    const Lanes reach = g.s_handover * g.s_handover;
    return (radial_product(g.y) < Lanes(0.0)) & (Lanes(0.0) < radial_product(g.y_new)) &
           (Lanes(angular_momentum * angular_momentum) < Lanes(reach * speed2));
  }
};

}  // namespace bristle::HWY_NAMESPACE
