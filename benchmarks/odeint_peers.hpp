#pragma once

#include "dynamics/passage.hpp"

namespace bristle::bench {

// Integrates a passage from y to its exit by Boost.Odeint as its users would: controlled steps without dense
// output, compiled for this processor, with the C library's elementary functions. Returns the time of the
// exit; y becomes the state there. There is no pole rule: only for bristles that do not reach the pole.
using OdeintPeer = double (*)(const PassageTask& task, OdeState& y);
[[gnu::visibility("default")]] double odeint_dopri5(const PassageTask& task, OdeState& y);
[[gnu::visibility("default")]] double odeint_cash_karp(const PassageTask& task, OdeState& y);

}  // namespace bristle::bench
