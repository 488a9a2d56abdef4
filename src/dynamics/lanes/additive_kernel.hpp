#pragma once

#include "dynamics/lanes/implicit_kernel.hpp"

namespace bristle::HWY_NAMESPACE {

// Steps by an additive Runge-Kutta pair. What makes the equations stiff, the in-plane damping by friction and by the azimuth's
// damper, is linear in the step: J (v - v_n) with J of its start is implicit, the rest explicit. J is 2 x 2: no more work than an
// explicit method's, and the order does not depend on how good J is.
template <class Tableau>
class AdditiveStep : public RosenbrockStep<Rodas4> {
 public:
  static constexpr double kExponent = Tableau::exponent;

  static HWY_FLATTEN Lanes attempt(Group& g) {
    constexpr int S = Tableau::stages;
    std::array<std::array<Lanes, COMPONENTS>, S> k;
    Lanes lx[S], ly[S];
    const auto J = in_plane_damping(g.bristle, g.y, k[0]);
    const Lanes hg = g.h * Lanes(Tableau::gamma);
    const Lanes one_hg = 1.0 / hg;
    const Lanes axx = 1.0 - hg * J(0, 0), axy = -Lanes(hg * J(0, 1)), ayx = -Lanes(hg * J(1, 0)), ayy = 1.0 - hg * J(1, 1);
    const Lanes one_det = 1.0 / (axx * ayy - axy * ayx);
    lx[0] = ly[0] = 0.0;
    for (int i = 1; i < S; ++i) {
      std::array<Lanes, kState> at;
      for (int c = 0; c < kState; ++c) {
        Lanes s = k[0][c] * Lanes(Tableau::a[i][0]);
        for (int j = 1; j < i; ++j) s += k[j][c] * Lanes(Tableau::a[i][j]);
        at[c] = g.y[c] + g.h * s;
      }
      Lanes mx = 0.0, my = 0.0;
      for (int j = 1; j < i; ++j) {
        const Lanes w = Tableau::a_implicit[i][j] - Tableau::a[i][j];
        mx += lx[j] * w;
        my += ly[j] * w;
      }
      const Lanes wx = (at[VX] - g.y[VX]) + g.h * mx, wy = (at[VY] - g.y[VY]) + g.h * my;
      const Lanes dx = Lanes(ayy * wx - axy * wy) * one_det, dy = Lanes(axx * wy - ayx * wx) * one_det;
      at[VX] = g.y[VX] + dx;
      at[VY] = g.y[VY] + dy;
      lx[i] = (dx - wx) * one_hg;
      ly[i] = (dy - wy) * one_hg;
      derivative<Lanes>(g.bristle, at, k[i]);
    }
    ErrorNorm norm(g);
    std::array<Lanes, COMPONENTS> e;
    for (int c = 0; c < COMPONENTS; ++c) {
      Lanes s = k[0][c] * Lanes(Tableau::b[0]);
      e[c] = k[0][c] * Lanes(Tableau::error[0]);
      for (int j = 1; j < S; ++j) {
        if (Tableau::b[j] != 0) s += k[j][c] * Lanes(Tableau::b[j]);
        if (Tableau::error[j] != 0) e[c] += k[j][c] * Lanes(Tableau::error[j]);
      }
      g.y_new[c] = g.y[c] + g.h * s;
      e[c] = e[c] * g.h;
    }
#ifdef FILTER
    const Lanes ex = Lanes(ayy * e[VX] - axy * e[VY]) * one_det, ey = Lanes(axx * e[VY] - ayx * e[VX]) * one_det;
    e[VX] = ex; e[VY] = ey;
#endif
    for (int c = 0; c < COMPONENTS; ++c) norm.add(c, e[c]);
    g.slope_new = g.slope;
    return norm.value();
  }
};

}  // namespace bristle::HWY_NAMESPACE
