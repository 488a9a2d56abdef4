#pragma once

#include "bristle/model/energy.hpp"

#include <array>

namespace bristle {

// Components of the initial value problem of one passage: the tip's state, then integrals over the local time
// xi from 0, on which no force depends. Dimensionless. slopes_of() states the time derivative of each
// component.
namespace component {
enum Component {
  X,
  Y,
  Z,
  VX,
  VY,
  VZ,
  THETA,
  PHI,
  NORMAL,      // F_n
  FRICTION_X,  // F_fx on the slab: the component against the slab's motion
  FRICTION_Y,
  MODULATION,  // F_n modulation, numerator of Eq. (24)
  ALIGNMENT,   // -F_n e_f.i, numerator of Eq. (25)
  AREA,        // F_n^(2/3), numerator of Eq. (26)
  WORK         // power(), the right-hand side of the energy balance
};
}  // namespace component
using component::Component;
constexpr int COMPONENTS = component::WORK + 1;
constexpr int kState = component::NORMAL;  // number of components on which forces depend
constexpr int kIntegrals = COMPONENTS - component::NORMAL;

// Returns the scale of atol for a component: the error of a step may be rtol |y| + atol
// tolerance_scale(c) for the component c.
constexpr double tolerance_scale(int c) { return component::VX <= c && c <= component::VZ ? 0.1 : 1; }

// Loads, and integrals of F_n over a passage, count as zero below this number. A tip that just touches the
// slab has less, from the rounding of its height, with the Hertz contact.
constexpr double kNoLoad = 1e-12;

using OdeState = std::array<double, COMPONENTS>;

template <class T, class Array>
State<T> unpack(const Array& y) {
  using namespace component;
  return {{y[X], y[Y], y[Z]}, {y[VX], y[VY], y[VZ]}, y[THETA], y[PHI]};
}

inline OdeState pack(const State<double>& s) {
  return {s.r[0], s.r[1], s.r[2], s.v[0], s.v[1], s.v[2], s.theta, s.phi};
}

// Sets dydt to the time derivative of every component. `pole` is has_pole() of the bristle.
template <class T, class P, class Out, class Pole>
void slopes_of(const Bristle<P>& b, const State<T>& state, const Motion<T>& m, Out& dydt, Pole pole) {
  using namespace component;
  for (int i = 0; i < 3; ++i) {
    dydt[X + i] = state.v[i];
    dydt[VX + i] = m.acceleration[i];
  }
  dydt[THETA] = pole ? m.rates.theta : T(0.0);
  dydt[PHI] = pole ? m.rates.phi : T(0.0);
  dydt[NORMAL] = m.contact.F_n;
  dydt[FRICTION_X] = m.friction[0];
  dydt[FRICTION_Y] = m.friction[1];
  dydt[MODULATION] = m.contact.F_n * m.sliding.modulation;
  dydt[ALIGNMENT] = -m.contact.F_n * m.sliding.e_x;
  dydt[AREA] = m.contact.F_n_23;
  dydt[WORK] = power(b, m);
}

template <class T, class P, class In, class Out>
void derivative(const Bristle<P>& b, const In& y, Out& dydt) {
  const State<T> state = unpack<T>(y);
  slopes_of(b, state, motion(b, state), dydt, has_pole(b.bending));
}

}  // namespace bristle
