#pragma once

#include "dynamics/lanes/group.hpp"

namespace bristle::HWY_NAMESPACE {

// Steps by an explicit pair. Stage slopes of the integrals enter only the step itself: no force depends on them.
template <class Tableau>
class ExplicitStep {
 public:
  static constexpr double kExponent = Tableau::exponent;

  static void refresh(Group& g) { derivative<Lanes>(g.bristle, g.y, g.slope); }

  // Fills y_new and slope_new; returns the largest error over tolerance.
  static HWY_FLATTEN Lanes attempt(Group& g) {
    constexpr int S = Tableau::stages;
    std::array<std::array<Lanes, COMPONENTS>, S> k;
    k[0] = g.slope;
    for (int i = 1; i < S; ++i) {
      std::array<Lanes, kState> at;
      for (int c = 0; c < kState; ++c) at[c] = g.y[c] + g.h * sum(k, Tableau::a[i], i, c);
      derivative<Lanes>(g.bristle, at, k[i]);
    }
    for (int c = 0; c < COMPONENTS; ++c) g.y_new[c] = g.y[c] + g.h * sum(k, Tableau::b, S, c);
    derivative<Lanes>(g.bristle, g.y_new, g.slope_new);
    ErrorNorm norm(g);
    for (int c = 0; c < COMPONENTS; ++c)
      norm.add(c, g.h * Lanes(sum(k, Tableau::error, S, c) + g.slope_new[c] * Lanes(Tableau::error[S])));
    return norm.value();
  }

  // Near the axis the equations are stiff, and an explicit step could cross it.
  static Lanes::Mask axis_event(const Group& g) {
    return (in_plane_square(g.y_new) < Lanes(g.near_axis * g.near_axis)) | passes_axis(g);
  }
  static Lanes::Mask leaves_axis(const Group&) { return Lanes(0.0) < Lanes(0.0); }

 private:
  template <class Slopes>
  static Lanes sum(const Slopes& k, const double* weight, int count, int component) {
    Lanes out = k[0][component] * Lanes(weight[0]);
    for (int j = 1; j < count; ++j)
      if (weight[j] != 0) out = out + k[j][component] * Lanes(weight[j]);
    return out;
  }

  // It was approaching, it recedes, and a straight line would have passed within near_axis.
  static Lanes::Mask passes_axis(const Group& g) {
    const Lanes moment = g.y[X] * g.y[VY] - g.y[Y] * g.y[VX];
    const Lanes speed2 = g.y[VX] * g.y[VX] + g.y[VY] * g.y[VY];
    const Lanes reach = g.near_axis * g.near_axis;
    return (radial_product(g.y) < Lanes(0.0)) & (Lanes(0.0) < radial_product(g.y_new)) &
           (Lanes(moment * moment) < Lanes(reach * speed2));
  }
};

}  // namespace bristle::HWY_NAMESPACE
