#pragma once

#include "dynamics/passage.hpp"

namespace bristle::bench {

// The same passages by SUNDIALS: CVODE's BDF with a dense Jacobian by differences, ARKODE's explicit
// Dormand-Prince 5(4); the exit by their root-finding. For bristles that do not come to the pole.
std::vector<Passage> run_cvode(const std::vector<PassageTask>& tasks);
std::vector<Passage> run_arkode(const std::vector<PassageTask>& tasks);

}  // namespace bristle::bench
