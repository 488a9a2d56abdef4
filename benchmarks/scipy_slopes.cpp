// The equations for SciPy through ctypes, so that it integrates the same compiled code as the other solvers.
#include "bristle/dynamics/ode.hpp"
#include "sample.hpp"

namespace {

const std::vector<bristle::PassageTask>& tasks() {
  static const bristle::bench::Bristles bristles(256, 1.8);
  static const auto all = bristles.at(1e-5);
  return all;
}

}  // namespace

extern "C" {

// Writes state and integrals (COMPONENTS numbers) of bristle i at the leading edge to y.
void bristle_start(int i, double* y) {
  const auto& task = tasks()[std::size_t(i)];
  const bristle::OdeState start = bristle::pack(bristle::state_at_rest(task.bristle, task.start));
  std::copy(start.begin(), start.end(), y);
}

void bristle_slope(int i, const double* y, double* dydt) {
  bristle::OdeState in, out;
  std::copy_n(y, bristle::COMPONENTS, in.begin());
  bristle::derivative<double>(tasks()[std::size_t(i)].bristle, in, out);
  std::copy(out.begin(), out.end(), dydt);
}
}
