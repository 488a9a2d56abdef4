#pragma once

#include "dynamics/lanes/group.hpp"
#include "dynamics/lanes/tableau.hpp"

namespace bristle::HWY_NAMESPACE {

// Solves (diagonal I - J) g = rhs for state and integrals by elimination without pivoting: damping and
// springs keep the pivots positive, and a bad pivot shows in the error estimate.
class Elimination {
 public:
  Elimination(const StateJacobianOf<Lanes>& J, const IntegralJacobianOf<Lanes>& integrals, const Lanes& diagonal)
      : integrals_(integrals), one_diagonal_(1.0 / diagonal) {
    for (int i = 0; i < kState; ++i)
      for (int j = 0; j < kState; ++j) lu_[i][j] = i == j ? diagonal - J(i, j) : -J(i, j);
    for (int k = 0; k < kState; ++k) {
      one_pivot_[k] = 1.0 / lu_[k][k];
      for (int i = k + 1; i < kState; ++i) {
        lu_[i][k] *= one_pivot_[k];
        for (int j = k + 1; j < kState; ++j) lu_[i][j] -= lu_[i][k] * lu_[k][j];
      }
    }
  }

  void solve(std::array<Lanes, COMPONENTS>& g) const {
    for (int i = 1; i < kState; ++i)
      for (int j = 0; j < i; ++j) g[i] -= lu_[i][j] * g[j];
    for (int i = kState - 1; i >= 0; --i) {
      for (int j = i + 1; j < kState; ++j) g[i] -= lu_[i][j] * g[j];
      g[i] *= one_pivot_[i];
    }
    for (int i = 0; i < kIntegrals; ++i) {
      Lanes& integral = g[NORMAL + i];
      for (int j = 0; j < kState; ++j) integral += integrals_(i, j) * g[j];
      integral *= one_diagonal_;
    }
  }

 private:
  const IntegralJacobianOf<Lanes>& integrals_;
  Lanes one_diagonal_;
  Lanes lu_[kState][kState], one_pivot_[kState];
};

// Steps by a Rosenbrock method; the Jacobian is automatic differentiation of the equations.
template <class Tableau>
class RosenbrockStep {
 public:
  static constexpr double kExponent = Tableau::exponent;

  static void refresh(Group&) {}

  static HWY_FLATTEN Lanes attempt(Group& g) {
    constexpr int S = Tableau::stages;
    StateJacobianOf<Lanes> J;
    IntegralJacobianOf<Lanes> J_integrals;
    std::array<std::array<Lanes, COMPONENTS>, S> k;
    jacobian(g.bristle, g.y, k[0], J, J_integrals);
    const Lanes one_h = 1.0 / g.h;
    const Elimination system(J, J_integrals, one_h * Lanes(1 / Tableau::gamma));
    system.solve(k[0]);
    for (int i = 1; i < S; ++i) {
      for (int c = 0; c < COMPONENTS; ++c) {
        g.y_new[c] = g.y[c];
        for (int j = 0; j < i; ++j)
          if (Tableau::a[i][j] != 0) g.y_new[c] += k[j][c] * Lanes(Tableau::a[i][j]);
      }
      derivative<Lanes>(g.bristle, g.y_new, k[i]);
      for (int c = 0; c < COMPONENTS; ++c) {
        Lanes memory = k[0][c] * Lanes(Tableau::c[i][0]);
        for (int j = 1; j < i; ++j) memory += k[j][c] * Lanes(Tableau::c[i][j]);
        k[i][c] += memory * one_h;
      }
      system.solve(k[i]);
    }
    // Stiffly accurate: the last stage is the step's error.
    ErrorNorm norm(g);
    for (int c = 0; c < COMPONENTS; ++c) {
      g.y_new[c] += k[S - 1][c];
      norm.add(c, k[S - 1][c]);
    }
    g.slope_new = g.slope;
    return norm.value();
  }

  // It may have come down to the pole: it is within at the end, or it was approaching, recedes, and was
  // or may have been near.
  static Lanes::Mask axis_event(const Group& g) {
    const Lanes zero = 0.0, reach = Lanes(g.pole * g.pole);
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
};

}  // namespace bristle::HWY_NAMESPACE
