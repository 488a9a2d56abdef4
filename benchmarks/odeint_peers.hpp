#pragma once

#include "dynamics/passage.hpp"

#include <vector>

namespace bristle::bench {

// Passages by Boost.Odeint at its best: compiled for this processor, with the C library's elementary
// functions, and with controlled steps without dense output. For bristles that do not reach the pole.
std::vector<Passage> run_odeint_dopri5(const std::vector<PassageTask>& tasks);
std::vector<Passage> run_odeint_cash_karp(const std::vector<PassageTask>& tasks);

}  // namespace bristle::bench
