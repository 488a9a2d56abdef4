// Error of the mean over theta_0 as a function of the number of passages, for the adaptive quadrature, an
// equidistant grid and random azimuths as in the paper's lattice. Writes JSON to standard output, from which
// python/bristle/pages/performance.py draws the figure.
#include "bristle/ensemble/point.hpp"
#include "bristle/model/friction/chi.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <random>

using namespace bristle;
using Json = nlohmann::ordered_json;

namespace {

struct Case {
  double k_r, z_0;
};

// The larger of the relative errors of R_n and R_x.
double error_of(double R_n, double R_x, const Ensemble& exact) {
  return std::max(std::abs(R_n / exact.mean[R_N] - 1), std::abs(R_x / exact.mean[R_X] - 1));
}

double mean_error(Setup setup, double z_0, std::vector<double> theta_0, const Ensemble& exact,
                  const PassageRunner& run) {
  setup.orientation.sampling = Sampling::list;
  setup.orientation.theta_0 = std::move(theta_0);
  EnsembleMean mean(setup, z_0, run);
  const Ensemble& e = mean.full();
  return error_of(e.mean[R_N], e.mean[R_X], exact);
}

Json compare(const Case& c) {
  const PassageRunner run = make_runner(Engine::fast);
  Setup setup;
  setup.parameters.k_r = c.k_r;
  setup.parameters.C = chi_C_peak_at_V_s(setup.parameters.A);
  setup.integrator = {1e-7, 1e-9, Method::automatic, 20'000'000};
  Setup fine = setup;
  fine.orientation.rtol = 3e-5;
  EnsembleMean reference(fine, c.z_0, run);
  const Ensemble exact = reference.full();
  Json out = {{"k_r", c.k_r},
              {"z_0", c.z_0},
              {"quadrature", Json::array()},
              {"grid", Json::array()},
              {"lattice", Json::array()}};
  for (const double rtol : {3e-2, 1e-2, 3e-3, 1e-3, 3e-4}) {
    setup.orientation.rtol = rtol;
    EnsembleMean mean(setup, c.z_0, run);
    const Ensemble& e = mean.full();
    out["quadrature"].push_back(
        {{"passages", e.passages},
         {"error", error_of(e.mean[R_N], e.mean[R_X], exact)},
         {"estimate", std::max(e.error[R_N] / e.mean[R_N], e.error[R_X] / e.mean[R_X])}});
  }
  std::mt19937_64 random(1);
  for (const int count : {40, 80, 160, 320, 640, 1280, 2560}) {
    std::vector<double> grid;
    for (int i = 0; i < count; ++i) grid.push_back(M_PI * (i + 0.5) / count);
    out["grid"].push_back({{"passages", count}, {"error", mean_error(setup, c.z_0, grid, exact, run)}});
    double squares = 0;
    constexpr int seeds = 8;
    for (int seed = 0; seed < seeds; ++seed) {
      std::vector<double> lattice;
      for (int i = 0; i < count; ++i) lattice.push_back(M_PI * double(random() >> 11) * 0x1p-53);
      const double error = mean_error(setup, c.z_0, lattice, exact, run);
      squares += error * error / seeds;
    }
    out["lattice"].push_back({{"passages", count}, {"error", std::sqrt(squares)}});
  }
  return out;
}

}  // namespace

int main() {
  Json cases = Json::array();
  for (const Case c : {Case{10, 0.1}, {25, 0.5}, {50, 0.62}}) {
    fmt::print(stderr, "quadrature at k_r {}, z_0 {} ...\n", c.k_r, c.z_0);
    cases.push_back(compare(c));
  }
  const Json out = {{"cases", cases}};
  fmt::print("{}\n", out.dump(1));
}
