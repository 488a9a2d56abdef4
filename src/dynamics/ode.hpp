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
template <class T, class P, class In, class Out>
void derivative(const Bristle<P>& b, const In& y, Out& dydt) {
  const State<T> state = unpack<T>(y);
  const Motion<T> m = motion(b, state);
  for (int i = 0; i < 3; ++i) {
    dydt[X + i] = state.v[i];
    dydt[VX + i] = m.acceleration[i];
  }
  dydt[THETA] = m.rates.theta;
  dydt[PHI] = m.rates.phi;
  dydt[NORMAL] = m.slab.F_n;
  dydt[FRICTION_X] = -m.slab.F_f * m.slab.e_x;
  dydt[FRICTION_Y] = -m.slab.F_f * m.slab.e_y;
  dydt[MODULATION] = m.slab.F_n * m.slab.modulation;
  dydt[ALIGNMENT] = -m.slab.F_n * m.slab.e_x;
  dydt[AREA] = m.slab.F_n_23;
  dydt[WORK] = power(b, m);
}

}  // namespace bristle
