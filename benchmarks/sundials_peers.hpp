#pragma once

#include "bristle/dynamics/passage.hpp"

namespace bristle::bench {

// Passages computed by SUNDIALS, with its root-finding for the exit: CVODE's BDF with a dense Jacobian by
// differences, and ARKODE's explicit Dormand-Prince 5(4). For bristles that do not reach the pole.
std::vector<Passage> run_cvode(const std::vector<PassageTask>& tasks);
std::vector<Passage> run_arkode(const std::vector<PassageTask>& tasks);

}  // namespace bristle::bench
