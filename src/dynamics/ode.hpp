#pragma once

#include "dynamics/components.hpp"
#include "model/energy.hpp"

namespace bristle {

template <class T, class Array>
State<T> unpack(const Array& y) {
  return {{y[X], y[Y], y[Z]}, {y[VX], y[VY], y[VZ]}, y[THETA], y[PHI]};
}

inline OdeState pack(const State<double>& s) {
  return {s.r[0], s.r[1], s.r[2], s.v[0], s.v[1], s.v[2], s.theta, s.phi};
}

// Time derivative of every component.
template <class T, class P, class Out>
void slopes_of(const Bristle<P>& b, const State<T>& state, const Motion<T>& m, Out& dydt) {
  for (int i = 0; i < 3; ++i) {
    dydt[X + i] = state.v[i];
    dydt[VX + i] = m.acceleration[i];
  }
  dydt[THETA] = m.rates.theta;
  dydt[PHI] = m.rates.phi;
  dydt[NORMAL] = m.wall.F_n;
  dydt[FRICTION_X] = m.friction[0];
  dydt[FRICTION_Y] = m.friction[1];
  dydt[MODULATION] = m.wall.F_n * m.sliding.modulation;
  dydt[ALIGNMENT] = -m.wall.F_n * m.sliding.e_x;
  dydt[AREA] = m.wall.F_n_23;
  dydt[WORK] = power(b, m);
}

template <class T, class P, class In, class Out>
void derivative(const Bristle<P>& b, const In& y, Out& dydt) {
  const State<T> state = unpack<T>(y);
  slopes_of(b, state, motion(b, state), dydt);
}

}  // namespace bristle
