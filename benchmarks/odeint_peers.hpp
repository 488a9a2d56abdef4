#pragma once

#include "bristle/dynamics/passage.hpp"

namespace bristle::bench {

// At the exit of a passage: its time, and how often the equations were evaluated.
struct OdeintExit {
  double time;
  long evaluations;
};

// Integrates a passage from y to its exit by Boost.Odeint as its users would: controlled steps without dense
// output, compiled for this processor, with the C library's elementary functions. y becomes the state at the
// exit. There is no pole rule: only for bristles that do not reach the pole.
using OdeintPeer = OdeintExit (*)(const PassageTask& task, OdeState& y);
[[gnu::visibility("default")]] OdeintExit odeint_dopri5(const PassageTask& task, OdeState& y);
[[gnu::visibility("default")]] OdeintExit odeint_cash_karp(const PassageTask& task, OdeState& y);

}  // namespace bristle::bench
