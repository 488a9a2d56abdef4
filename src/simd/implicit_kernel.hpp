#pragma once

#include "dynamics/jacobian.hpp"
#include "simd/group.hpp"

namespace bristle::HWY_NAMESPACE {

// Steps by an additive Runge-Kutta pair. The stiff terms damp the velocity v: friction and the dampers of
// azimuth and polar angle. The implicit part is J (v - v_n), where J is the Jacobian of the acceleration by
// the velocity at the start of the step; all other terms are explicit. J is 3 x 3, so a stage costs hardly
// more than that of an explicit method. The order does not depend on the accuracy of J.
template <class Tableau>
class AdditiveStep {
 public:
  static constexpr double kExponent = Tableau::exponent;

  static void refresh(Group&) {}

  // Computes y_new; returns the largest ratio of error to tolerance.
  static Lanes attempt(Group& g) {
    Slopes<S> k;
    Slopes<S, 3> implicit;  // J (v - v_n) at the stages
    const Damping damping(g, evaluate_damping(g.bristle, g.y, k[0]));
    implicit[0] = {0.0, 0.0, 0.0};
    stages(g, damping, k, implicit, std::make_index_sequence<S>());
    std::array<Lanes, COMPONENTS> error;
    for (int c = 0; c < COMPONENTS; ++c) {
      g.y_new[c] = g.y[c] + g.h * weighted_sum<S>(k, c, [](int j) { return Tableau::b[j]; });
      error[c] = g.h * weighted_sum<S>(k, c, [](int j) { return Tableau::error[j]; });
    }
    ErrorNorm norm(g);
    for (int c = 0; c < COMPONENTS; ++c) norm.add(c, error[c]);
    g.slope_new = g.slope;  // not used
    return norm.value();
  }

  // The tip may have reached s_min: it is inside at the end of the step and
  // approaches the pole; or it approached at the start, recedes at the end,
  // and either is near the pole or has a straight path that comes near it.
  static Lanes::Mask pole_event(const Group& g) {
    const Lanes zero = 0.0, reach = g.s_min * g.s_min;
    const auto aims_at_pole = [&](const auto& y) {
      const Lanes angular_momentum = y[X] * y[VY] - y[Y] * y[VX];
      return Lanes(angular_momentum * angular_momentum) <
             Lanes(Lanes(4.0 * reach) * Lanes(y[VX] * y[VX] + y[VY] * y[VY]));
    };
    const Lanes::Mask within =
        (in_plane_distance_squared(g.y_new) < 1.01 * reach) & (radial_product(g.y_new) < zero);
    const Lanes::Mask turned = (radial_product(g.y) < zero) & (radial_product(g.y_new) >= zero);
    const Lanes::Mask near = (in_plane_distance_squared(g.y) < 100.0 * reach) |
                             (in_plane_distance_squared(g.y_new) < 100.0 * reach);
    return within | (turned & (near | aims_at_pole(g.y) | aims_at_pole(g.y_new)));
  }

  static Lanes::Mask leaves_pole(const Group& g) {
    return Lanes(g.s_handover * g.s_handover) < in_plane_distance_squared(g.y_new);
  }

 private:
  static constexpr int S = Tableau::stages;

  static HWY_NOINLINE HWY_FLATTEN Eigen::Matrix<Lanes, 3, 3> evaluate_damping(
      const Bristle<Lanes>& b, const std::array<Lanes, COMPONENTS>& y, std::array<Lanes, COMPONENTS>& slope) {
    return damping_matrix(b, y, slope);
  }

  // The inverse of I - h gamma J, by cofactors.
  struct Damping {
    Damping(const Group& g, const Eigen::Matrix<Lanes, 3, 3>& J)
        : h_gamma(g.h * Lanes(Tableau::gamma)), one_h_gamma(1.0 / h_gamma) {
      Lanes m[3][3];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) m[i][j] = (i == j ? 1.0 : 0.0) - h_gamma * J(i, j);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
          inverse[i][j] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
        }
      const Lanes one_det =
          1.0 / (m[0][0] * inverse[0][0] + (m[0][1] * inverse[1][0] + m[0][2] * inverse[2][0]));
      for (auto& row : inverse)
        for (Lanes& entry : row) entry *= one_det;
    }
    Lanes h_gamma, one_h_gamma, inverse[3][3];
  };

  template <std::size_t... I>
  static HWY_INLINE void stages(const Group& g, const Damping& damping, Slopes<S>& k, Slopes<S, 3>& implicit,
                                std::index_sequence<I...>) {
    (stage<int(I)>(g, damping, k, implicit), ...);
  }
  template <int I>
  static HWY_INLINE void stage(const Group& g, const Damping& damping, Slopes<S>& k, Slopes<S, 3>& implicit) {
    if constexpr (I > 0) {
      std::array<Lanes, kState> at;
      for (int c = 0; c < kState; ++c)
        at[c] = g.y[c] + g.h * weighted_sum<I>(k, c, [](int j) { return Tableau::a[I][j]; });
      // The sum above weights the implicit parts of the slopes by a; they need the weights a_implicit. The
      // implicit part of this stage is still unknown.
      const auto correction = [&](int c) {
        return weighted_sum<I>(implicit, c,
                               [](int j) { return Tableau::a_implicit[I][j] - Tableau::a[I][j]; });
      };
      Lanes explicit_v[3];  // v - v_n without the implicit part of this stage
      for (int i = 0; i < 3; ++i) explicit_v[i] = (at[VX + i] - g.y[VX + i]) + g.h * correction(i);
      for (int i = 0; i < 3; ++i) {
        const auto& row = damping.inverse[i];
        const Lanes v = row[0] * explicit_v[0] + (row[1] * explicit_v[1] + row[2] * explicit_v[2]);
        implicit[I][i] = Lanes(v - explicit_v[i]) * damping.one_h_gamma;
        at[VX + i] = g.y[VX + i] + v;
      }
      evaluate(g.bristle, at.data(), k[I]);
    }
  }
};

}  // namespace bristle::HWY_NAMESPACE
