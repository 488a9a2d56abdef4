#pragma once

#include "dynamics/lanes/group.hpp"

namespace bristle::HWY_NAMESPACE {

// Steps by an additive Runge-Kutta pair. What makes the equations stiff is the damping of the in-plane velocity v
// by friction and by the azimuth's damper: J (v - v_n), with J its derivative at the step's start, is
// the implicit part, the rest the explicit one. J is 2 x 2, so that a stage costs no more than an explicit
// method's, and the order does not depend on how good J is.
template <class Tableau>
class AdditiveStep {
 public:
  static constexpr double kExponent = Tableau::exponent;

  static void refresh(Group&) {}

  // Fills y_new; returns the largest error over tolerance.
  static Lanes attempt(Group& g) {
    Slopes<S> k;
    Slopes<S, 2> implicit;  // J (v - v_n) at the stages
    const Damping damping(g, evaluate_damping(g.bristle, g.y, k[0]));
    implicit[0] = {0.0, 0.0};
    stages(g, damping, k, implicit, std::make_index_sequence<S>());
    std::array<Lanes, COMPONENTS> error;
    for (int c = 0; c < COMPONENTS; ++c) {
      g.y_new[c] = g.y[c] + g.h * combine<S>(k, c, [](int j) { return Tableau::b[j]; });
      error[c] = g.h * combine<S>(k, c, [](int j) { return Tableau::error[j]; });
    }
    ErrorNorm norm(g);
    for (int c = 0; c < COMPONENTS; ++c) norm.add(c, error[c]);
    g.slope_new = g.slope;  // not used
    return norm.value();
  }

  // It may have come down to the pole: it is within at the end, or it was approaching, recedes, and was
  // or may have been near.
  static Lanes::Mask axis_event(const Group& g) {
    const Lanes zero = 0.0, reach = g.pole * g.pole;
    const auto aims_at_it = [&](const auto& y) {
      const Lanes moment = y[X] * y[VY] - y[Y] * y[VX];
      return Lanes(moment * moment) < Lanes(Lanes(4.0 * reach) * Lanes(y[VX] * y[VX] + y[VY] * y[VY]));
    };
    const Lanes::Mask within = (in_plane_square(g.y_new) < 1.01 * reach) & (radial_product(g.y_new) < zero);
    const Lanes::Mask turned = (radial_product(g.y) < zero) & (radial_product(g.y_new) >= zero);
    const Lanes::Mask near = (in_plane_square(g.y) < 100.0 * reach) | (in_plane_square(g.y_new) < 100.0 * reach);
    return within | (turned & (near | aims_at_it(g.y) | aims_at_it(g.y_new)));
  }

  static Lanes::Mask leaves_axis(const Group& g) {
    return Lanes(g.near_axis * g.near_axis) < in_plane_square(g.y_new);
  }

 private:
  static constexpr int S = Tableau::stages;

  static HWY_NOINLINE HWY_FLATTEN Eigen::Matrix<Lanes, 2, 2> evaluate_damping(
      const Bristle<Lanes>& b, const std::array<Lanes, COMPONENTS>& y, std::array<Lanes, COMPONENTS>& slope) {
    return in_plane_damping(b, y, slope);
  }

  // The inverse of I - h gamma J.
  struct Damping {
    Damping(const Group& g, const Eigen::Matrix<Lanes, 2, 2>& J)
        : h_gamma(g.h * Lanes(Tableau::gamma)), one_h_gamma(1.0 / h_gamma) {
      const Lanes a = 1.0 - h_gamma * J(0, 0), b = h_gamma * J(0, 1);
      const Lanes c = h_gamma * J(1, 0), d = 1.0 - h_gamma * J(1, 1);
      const Lanes one_det = 1.0 / (a * d - b * c);
      xx = d * one_det;
      xy = b * one_det;
      yx = c * one_det;
      yy = a * one_det;
    }
    Lanes h_gamma, one_h_gamma, xx, xy, yx, yy;
  };

  template <std::size_t... I>
  static HWY_INLINE void stages(const Group& g, const Damping& damping, Slopes<S>& k, Slopes<S, 2>& implicit,
                                std::index_sequence<I...>) {
    (stage<int(I)>(g, damping, k, implicit), ...);
  }
  template <int I>
  static HWY_INLINE void stage(const Group& g, const Damping& damping, Slopes<S>& k, Slopes<S, 2>& implicit) {
    if constexpr (I > 0) {
      std::array<Lanes, kState> at;
      for (int c = 0; c < kState; ++c)
        at[c] = g.y[c] + g.h * combine<I>(k, c, [](int j) { return Tableau::a[I][j]; });
      // Of the slopes' sum the implicit part is to be weighted otherwise, and this stage's is yet to be found.
      const auto missing = [&](int c) {
        return combine<I>(implicit, c, [](int j) { return Tableau::a_implicit[I][j] - Tableau::a[I][j]; });
      };
      const Lanes x = (at[VX] - g.y[VX]) + g.h * missing(0), y = (at[VY] - g.y[VY]) + g.h * missing(1);
      const Lanes v_x = damping.xx * x + damping.xy * y, v_y = damping.yx * x + damping.yy * y;
      implicit[I] = {Lanes(v_x - x) * damping.one_h_gamma, Lanes(v_y - y) * damping.one_h_gamma};
      at[VX] = g.y[VX] + v_x;
      at[VY] = g.y[VY] + v_y;
      evaluate(g.bristle, at, k[I]);
    }
  }
};

}  // namespace bristle::HWY_NAMESPACE
