// The friction of the paper's brush, with rods for bristles, under a load: one point of an experiment,
// without a file.
#include <bristle/ensemble/point.hpp>
#include <bristle/model/friction/chi.hpp>
#include <bristle/simd/runner.hpp>

#include <cstdio>

int main() {
  bristle::Setup setup;  // the paper's parameters, dimensionless
  setup.parameters.bending = bristle::Bending::rod;
  setup.parameters.k_r = 30;
  setup.parameters.C = bristle::chi_C_peak_at_V_s(setup.parameters.A);
  setup.integrator = {.rtol = 1e-4, .atol = 2e-4};  // as in experiments/paper.json
  const auto run = bristle::make_runner(bristle::Engine::fast);
  const bristle::PointResult point = bristle::solve_point(setup, {.R_n = 2}, run);
  std::printf("R_n = %.6g +- %.1g\n", point.value[bristle::R_N], point.error[bristle::R_N]);
  std::printf("R_x relative to rigid bristles = %.6g +- %.1g\n", point.R_x_norm.value, point.R_x_norm.error);
}
