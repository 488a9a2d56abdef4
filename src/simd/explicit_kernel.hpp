#pragma once

#include "simd/group.hpp"

namespace bristle::HWY_NAMESPACE {

// Steps by an explicit pair. Stage slopes of the integrals enter only the step itself: no force depends on
// them.
template <class Tableau>
class ExplicitStep {
 public:
  static constexpr double kExponent = Tableau::exponent;

  static void refresh(Group& g) { evaluate(g.bristle, g.y, g.slope); }

  // Fills y_new and slope_new; returns the largest error over tolerance.
  static Lanes attempt(Group& g) {
    Slopes<S> k;
    k[0] = g.slope;
    stages(g, k, std::make_index_sequence<S>());
    for (int c = 0; c < COMPONENTS; ++c)
      g.y_new[c] = g.y[c] + g.h * combine<S>(k, c, [](int j) { return Tableau::b[j]; });
    evaluate(g.bristle, g.y_new, g.slope_new);
    ErrorNorm norm(g);
    for (int c = 0; c < COMPONENTS; ++c) {
      const Lanes others = combine<S>(k, c, [](int j) { return Tableau::error[j]; });
      norm.add(c, g.h * Lanes(others + g.slope_new[c] * Lanes(Tableau::error[S])));
    }
    return norm.value();
  }

  // Near the axis the equations are stiff, and an explicit step could cross it.
  static Lanes::Mask pole_event(const Group& g) {
    return (in_plane_square(g.y_new) < Lanes(g.near_pole * g.near_pole)) | passes_pole(g);
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
        at[c] = g.y[c] + g.h * combine<I>(k, c, [](int j) { return Tableau::a[I][j]; });
      evaluate(g.bristle, at, k[I]);
    }
  }

  // It was approaching, it recedes, and a straight line would have passed within near_pole.
  static Lanes::Mask passes_pole(const Group& g) {
    const Lanes moment = g.y[X] * g.y[VY] - g.y[Y] * g.y[VX];
    const Lanes speed2 = g.y[VX] * g.y[VX] + g.y[VY] * g.y[VY];
    const Lanes reach = g.near_pole * g.near_pole;
    return (radial_product(g.y) < Lanes(0.0)) & (Lanes(0.0) < radial_product(g.y_new)) &
           (Lanes(moment * moment) < Lanes(reach * speed2));
  }
};

}  // namespace bristle::HWY_NAMESPACE
