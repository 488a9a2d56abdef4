#include "bristle/model/equilibrium.hpp"

#include "bristle/model/energy.hpp"
#include "bristle/model/error.hpp"
#include "bristle/message.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bristle {
namespace {

// Value of a function and its derivative.
struct Tangent {
  double value, slope;
};

// Returns the root of a function that is negative at lower and not negative at upper, by Newton's method from
// guess. Bisects where a step of Newton's method leaves the bracket or is longer than the step before it.
template <class Function>
double bracketed_root(Function function, double lower, double upper, double guess) {
  constexpr double converged = 1e-12;  // a Newton step of this relative size is correct to rounding
  constexpr double rounding = 4e-16;
  constexpr int most_steps = 60;  // then bisection: Newton's method may be slow far away from the root
  double x = guess > lower && guess < upper ? guess : lower + (upper - lower) / 2;
  double last = upper - lower;
  for (int i = 0;; ++i) {
    const Tangent t = function(x);
    (t.value < 0 ? lower : upper) = x;
    const double step = -t.value / t.slope;
    // Deep in the wall the slope overflows, and the step is 0 far from the root.
    if (std::isfinite(t.slope) && std::abs(step) <= converged * std::abs(x)) return x + step;
    const bool newton = i < most_steps && x + step > lower && x + step < upper && std::abs(step) <= last;
    const double next = newton ? x + step : lower + (upper - lower) / 2;
    last = std::abs(next - x);
    x = next;
    if (last <= rounding * std::abs(x)) return x;
  }
}

// A bristle at the polar angle phi with its tip at the radius where the radial forces balance.
class Bent {
 public:
  // Finds the radius of balance. z is a guess of the tip's height, such as its height at a similar angle.
  Bent(const Bristle<double>& b, double phi, double z) : b_(b), phi_(phi), sin_(sin(phi)), cos_(cos(phi)) {
    // The radial force increases strictly with r: without a negative sign at r = 0 it has no root.
    if (sin_ * contact_force(b_, 0.0).F_n >= b.k_r + cos_ * b.pole_peak) {
      r_ = std::numeric_limits<double>::quiet_NaN();
    } else {
      const double r_max = 1 + b.pole_peak / b.k_r;
      r_ = bracketed_root([this](double r) { return radial(r); }, 0, r_max, std::min(1.0, z / sin_));
    }
  }

  // Returns the radius; NaN if a wall that reaches down to r = 0 compresses the spring completely.
  double r() const { return r_; }
  double z() const { return r_ * sin_; }

  // Returns dU/dphi along the balanced radius, and its derivative. dU/dphi is zero at an equilibrium.
  Tangent polar() const {
    const double s = r_ * cos_, z = r_ * sin_;
    const double F_n = contact_force(b_, z).F_n, F_n_slope = contact_stiffness(b_, z);
    const double pole = pole_at(r_), pole_slope = pole * b_.pole_rate;
    const double U_phi_phi = b_.k_phi - z * F_n + s * s * F_n_slope + s * pole + z * z * pole_slope;
    const double U_r_phi = cos_ * F_n + sin_ * s * F_n_slope + sin_ * pole - cos_ * z * pole_slope;
    const double U_r_r = b_.k_r + sin_ * sin_ * F_n_slope + cos_ * cos_ * pole_slope;
    return {b_.k_phi * (phi_ - b_.phi_0) + s * F_n + z * pole, U_phi_phi - U_r_phi * U_r_phi / U_r_r};
  }

 private:
  double pole_at(double r) const { return short_range_force(r * cos_, b_.pole_peak, b_.pole_rate); }

  Tangent radial(double r) const {
    const double z = r * sin_, pole = pole_at(r);
    return {b_.k_r * (r - 1) + sin_ * contact_force(b_, z).F_n - cos_ * pole,
            b_.k_r + sin_ * sin_ * contact_stiffness(b_, z) + cos_ * cos_ * pole * b_.pole_rate};
  }

  const Bristle<double>& b_;
  double phi_, sin_, cos_, r_;
};

// A bristle at the polar angle phi with its tip at the slab, z = z_0.
class AtSlab {
 public:
  AtSlab(const Bristle<double>& b, double phi) : b_(b), phi_(phi), tan_(tan(phi)), r_(b.z_0 / sin(phi)) {}

  double r() const { return r_; }

  // Returns dU/dphi of springs and pole repulsion along z = z_0, and its derivative.
  Tangent polar() const {
    const double pole = short_range_force(r_ * cos(phi_), b_.pole_peak, b_.pole_rate);
    const double s_slope = b_.z_0 / (sin(phi_) * sin(phi_));  // -ds/dphi
    return {b_.k_phi * (phi_ - b_.phi_0) - b_.k_r * (r_ - 1) * r_ / tan_ + pole * s_slope,
            b_.k_phi + b_.k_r * ((2 * r_ - 1) * r_ / (tan_ * tan_) + (r_ - 1) * s_slope / sin(phi_)) +
                pole * s_slope * (b_.pole_rate * s_slope - 2 / tan_)};
  }

 private:
  const Bristle<double>& b_;
  double phi_, tan_, r_;
};

// Finds the polar angle of the minimum of the energy over 0 < phi <= phi_0 that is downhill from phi: dU/dphi
// is negative below it and not negative above it. Searches in steps, so as not to step over a maximum to
// another minimum. Returns NaN if there is none.
template <class Polar>
double downhill(Polar polar, double phi, double phi_0) {
  const double step = phi_0 / 64, least = 1e-9;
  double lower = phi, upper = phi, slope = polar(phi).value;
  if (slope < 0) {
    while (upper < phi_0 && slope < 0) {
      lower = upper;
      upper = std::min(phi_0, upper + step);
      slope = polar(upper).value;
    }
    if (slope < 0) return phi_0;
  } else {
    while (!(slope < 0)) {
      if (lower <= least) return std::numeric_limits<double>::quiet_NaN();
      upper = lower;
      lower = std::max(least, lower - step);
      slope = polar(lower).value;
    }
  }
  return bracketed_root(polar, lower, upper, phi);
}

}  // namespace

FollowedMinimum::Step FollowedMinimum::minimum(double z_0, const Step& from) const {
  Bristle<double> b = bristle_;
  b.z_0 = z_0;
  double z = from.z;
  const auto polar = [&](double angle) {
    if (at_slab_) return AtSlab(b, angle).polar();
    const Bent bent(b, angle, z);
    z = std::isnan(bent.z()) ? z_0 : bent.z();
    return bent.polar();
  };
  double phi = downhill(polar, from.phi, b.phi_0);
  // Where the wall compresses the spring to nothing, dU/dphi has no value, and the search may end at the
  // edge of that range, without a balance.
  constexpr double least_radius = 1e-6;
  if (!at_slab_ && Bent(b, phi, z).r() < least_radius) phi = std::numeric_limits<double>::quiet_NaN();
  return {z_0, phi, z};
}

double FollowedMinimum::phi(double z_0) {
  constexpr double step = 1. / 64;  // change of the gap, in units of r0
  const double contact = sin(bristle_.phi_0);
  Step last = {contact, bristle_.phi_0, contact};
  double gap = contact;
  for (std::size_t i = 0; gap > z_0 && !std::isnan(last.phi); ++i, gap -= step) {
    if (i == steps_.size()) steps_.push_back(minimum(gap, last));
    last = steps_[i];
  }
  return std::isnan(last.phi) ? last.phi : minimum(z_0, last).phi;
}

namespace {

Equilibrium static_equilibrium(Bristle<double> b, double z_0, FollowedMinimum& minimum) {
  b.z_0 = z_0;
  const double phi = minimum.phi(z_0);
  const double r = std::isnan(phi) ? phi : Bent(b, phi, z_0).r();
  if (std::isnan(r))
    throw ModelError(message(
        "no static equilibrium of the bristle under a slab that comes down to z_0 = ", six_digits(z_0),
        ": the wall (lambda_z, beta) is stronger than the springs (k_r, k_phi)"));
  return {r, phi};
}

// Returns the position with the undeformed radius and the tip just out of the slab's reach: the springs' only
// energy is the energy of bending.
Equilibrium unstretched(const Parameters& p, double z_0) {
  constexpr double clearance = 5;  // in units of contact_range()
  return {1, std::min(asin(std::clamp(z_0 - clearance * contact_range(p), 0.0, 1.0)), p.phi_0)};
}

}  // namespace

Equilibrium static_equilibrium(const Bristle<double>& b) {
  FollowedMinimum minimum(b, false);
  return static_equilibrium(b, b.z_0, minimum);
}

InitialStates::InitialStates(const Parameters& p)
    : p_(p), minimum_(make_bristle(p, 0, 0), p.initial_state == InitialState::at_slab) {}

Equilibrium InitialStates::at(double z_0) {
  const Bristle<double> b = make_bristle(p_, z_0, 0);
  switch (p_.initial_state) {
    case InitialState::at_slab: {
      const double phi = minimum_.phi(z_0);
      return {AtSlab(b, phi).r(), phi};
    }
    case InitialState::unstretched: return unstretched(p_, z_0);
    case InitialState::upright: return {z_0 / sin(p_.phi_0), p_.phi_0};
    case InitialState::static_equilibrium: break;
  }
  return static_equilibrium(b, z_0, minimum_);
}

Start InitialStates::start() {
  constexpr double ground = 0.01;
  if (p_.initial_state != InitialState::static_equilibrium && p_.initial_state != InitialState::at_slab)
    return Start::undetermined;
  const double phi = minimum_.phi(ground);
  return std::isnan(phi) ? Start::undetermined : phi > p_.phi_0 / 2 ? Start::crushed : Start::bent;
}

State<double> state_at_rest(const Bristle<double>& b, const Equilibrium& e) {
  const double s = e.r * cos(e.phi);
  return {{s * cos(b.theta_0), s * sin(b.theta_0), e.r * sin(e.phi)}, {0, 0, 0}, b.theta_0, e.phi};
}

}  // namespace bristle
