#include "bristle/dynamics/stability.hpp"

#include "bristle/dynamics/jacobian.hpp"
#include "bristle/model/equilibrium.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>

namespace bristle {
namespace {

using namespace component;

// Number of components for the position and velocity of the tip.
constexpr int kTip = THETA;
using TipJacobian = Eigen::Matrix<double, kTip, kTip>;

// Returns the Jacobian of the bristle b at rest at y, with respect to the tip's position and velocity. At
// rest theta and phi follow the position alone, d(theta) = (d theta'/d v) . dr, so their columns are added to
// its columns.
TipJacobian tip_jacobian(const Bristle<double>& b, const OdeState& y) {
  StateJacobian full;
  IntegralJacobian unused;
  jacobian(b, y, full, unused);
  TipJacobian of_tip = full.topLeftCorner<kTip, kTip>();
  for (const int angle : {THETA, PHI})
    of_tip.leftCols<3>() += full.col(angle).head<kTip>() * full.row(angle).segment<3>(VX);
  return of_tip;
}

// A tip that rests in the vertical plane of the motion.
struct Rest {
  double x, z;
};

Equilibrium polar(const Rest& tip) {
  const double r = std::sqrt(tip.x * tip.x + tip.z * tip.z);
  return {r, asin(tip.z / r)};
}

OdeState state_of(const Bristle<double>& b, const Rest& tip) { return pack(state_at_rest(b, polar(tip))); }

// Returns a tip at the height z at the same distance from its root as `tip`; x is NaN if that is too high.
Rest at_height(const Rest& tip, double z) { return {std::sqrt(tip.x * tip.x + tip.z * tip.z - z * z), z}; }

// Returns the place near the tip at which the bristle b rests on the moving slab, by Newton's method. x is
// NaN if the method finds none.
Rest resting_place(const Bristle<double>& b, Rest tip) {
  constexpr int kIterations = 50;
  constexpr double kTolerance = 1e-11;  // length of the last step, in units of r0
  for (int i = 0; i < kIterations && tip.x > 0 && tip.z > 0; ++i) {
    const OdeState y = state_of(b, tip);
    OdeState slope;
    derivative<double>(b, y, slope);
    const TipJacobian of_tip = tip_jacobian(b, y);
    Eigen::Matrix2d in_plane;
    in_plane << of_tip(VX, X), of_tip(VX, Z), of_tip(VZ, X), of_tip(VZ, Z);
    const Eigen::Vector2d step = in_plane.fullPivLu().solve(-Eigen::Vector2d(slope[VX], slope[VZ]));
    tip = {tip.x + step[0], tip.z + step[1]};
    if (step.norm() < kTolerance) return tip;
  }
  return {NAN, NAN};
}

// Returns the rows and columns of of_tip for these components.
template <std::size_t N>
Eigen::Matrix<double, N, N> part(const TipJacobian& of_tip, const std::array<Component, N>& components) {
  Eigen::Matrix<double, N, N> out;
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t k = 0; k < N; ++k) out(i, k) = of_tip(components[i], components[k]);
  return out;
}

template <class Matrix>
Mode least_stable(const Matrix& linear) {
  const Eigen::Vector<std::complex<double>, Matrix::RowsAtCompileTime> values = linear.eigenvalues();
  const std::complex<double> most =
      *std::ranges::max_element(values, {}, [](const std::complex<double>& value) { return value.real(); });
  return {most.real(), std::abs(most.imag())};
}

}  // namespace

SteadySliding steady_sliding(const Parameters& p, double z_0) {
  constexpr double kLargestStep = 2e-3, kLeastStep = 1e-6;  // change of the gap in one step
  Bristle<double> b = make_bristle(p, z_0, 0);
  b.z_0 = std::max(z_0, sin(p.phi_0) + 3 * kOffSlabRanges * contact_range(p));  // where a wall is hardly felt
  Rest tip = resting_place(b, {cos(p.phi_0), sin(p.phi_0)});
  for (double step = kLargestStep; b.z_0 > z_0 && !std::isnan(tip.x);) {
    const double before = b.z_0;
    b.z_0 = std::max(z_0, before - step);
    // The tip comes down with the slab, so that the load changes little.
    const Rest next = resting_place(b, at_height(tip, tip.z + b.z_0 - before));
    if (!std::isnan(next.x)) {
      tip = next;
      step = std::min(2 * step, kLargestStep);
    } else if (step > kLeastStep) {
      b.z_0 = before;
      step /= 2;
    } else {
      tip = next;
    }
  }
  if (std::isnan(tip.x)) return {};
  const TipJacobian of_tip = tip_jacobian(b, state_of(b, tip));
  const auto [r, phi] = polar(tip);
  return {r, phi, contact_force(b, tip.z).F_n, least_stable(part(of_tip, std::array{X, Z, VX, VZ})),
          least_stable(part(of_tip, std::array{Y, VY}))};
}

}  // namespace bristle
