#include "bristle/ensemble/derived.hpp"
#include "ensembles.hpp"

#include "catch.hpp"
#include <algorithm>
#include <cmath>

namespace bristle::ensemble_test {
using namespace testing;
using namespace component;

TEST_CASE("the range of pinned bristles near theta_0 = 180 degrees is located") {
  const Ensemble e = ensemble_mean(paper(50), 0.62);
  REQUIRE(!e.jumps.empty());
  const double border = e.jumps.back() * 180 / M_PI;
  CHECK(border == Approx(178.1).margin(0.1));
  CHECK(e.mean[PINNED_FRACTION] == Approx((180 - border) / 180).epsilon(0.02));
  CHECK(e.mean[pinned(R_X)] / e.mean[R_X] > 0.2);  // 1 % of the bristles cause a quarter of the friction
}

TEST_CASE(
    "without using symmetry R_y vanishes over the full circle, and the other means equal those of the half") {
  Setup whole = paper(10, 3e-3);
  whole.orientation.full_circle = true;
  const Ensemble full = ensemble_mean(whole, 0.5), half = ensemble_mean(paper(10, 3e-3), 0.5);
  CHECK(full.error[R_Y] > 0);
  CHECK(std::abs(full.mean[R_Y]) <= full.error[R_Y]);
  CHECK(full.error[R_Y] <= 3e-3 * full.mean[R_X]);
  CHECK(half.mean[R_Y] == 0);
  for (const Observable k : {N_C_RATIO, R_N, R_X, GAMMA_1, GAMMA_2, GAMMA_3})
    CHECK(std::abs(full.mean[k] - half.mean[k]) <= 2 * (full.error[k] + half.error[k]));
}

TEST_CASE("a von Mises distribution is isotropic at zero concentration, and otherwise causes R_y") {
  Setup i = paper(10, 3e-3);
  const Ensemble uniform = ensemble_mean(i, 0.5);
  i.orientation.distribution = Distribution::von_mises;
  i.orientation.full_circle = true;
  const Ensemble flat = ensemble_mean(i, 0.5);
  CHECK(std::abs(flat.mean[R_X] - uniform.mean[R_X]) <= 2 * (flat.error[R_X] + uniform.error[R_X]));
  i.orientation.concentration = 5;
  i.orientation.mean = M_PI / 2;
  const Ensemble sideways = ensemble_mean(i, 0.5);
  i.orientation.mean = -M_PI / 2;
  const Ensemble mirrored = ensemble_mean(i, 0.5);
  CHECK(std::abs(sideways.mean[R_Y]) > 10 * sideways.error[R_Y]);
  CHECK(std::abs(sideways.mean[R_Y] + mirrored.mean[R_Y]) <= 2 * (sideways.error[R_Y] + mirrored.error[R_Y]));
}

TEST_CASE("the density of a von Mises distribution has the integral 1 at every concentration") {
  for (const double kappa : {1e-3, 0.5, 3.0, 20.0, 1e3, 1e8}) {
    Setup setup = paper(10, 1e-3);
    setup.orientation.distribution = Distribution::von_mises;
    setup.orientation.concentration = kappa;
    setup.orientation.mean = 1.357;
    const Ensemble e = ensemble_mean(setup, 0.5);
    CAPTURE(kappa, e.error[WEIGHT]);
    CHECK(e.converged);
    CHECK(e.mean[WEIGHT] == Approx(1).epsilon(1e-3));
  }
}

TEST_CASE("a narrow distribution gives the values of its only azimuth") {
  Setup list = paper(10);
  list.orientation.sampling = Sampling::list;
  for (const double mean : {0.0, 1.357, -2.9, M_PI}) {
    list.orientation.theta_0 = {mean};
    const Ensemble one = ensemble_mean(list, 0.5);
    Setup narrow = paper(10);
    narrow.orientation.distribution = Distribution::von_mises;
    narrow.orientation.concentration = 1e8;
    narrow.orientation.mean = mean;
    const Ensemble e = ensemble_mean(narrow, 0.5);
    CAPTURE(mean);
    for (const Observable k : {R_N, R_X, GAMMA_2}) CHECK(e.mean[k] == Approx(one.mean[k]).epsilon(1e-3));
  }
}

TEST_CASE("a point whose equations are evaluated too often has the status work_limit and no values") {
  Setup setup = paper(10);
  setup.max_evaluations_per_point = 100'000;
  for (const Loading loading : {Loading{}, Loading{0.5}}) {
    const PointResult r = solve(setup, loading);
    CHECK(r.status == PointStatus::work_limit);
    CHECK(std::isnan(r.value[R_N]));
    CHECK(r.passages > 0);
  }
}

TEST_CASE("points without friction have the status undefined, and a bounded energy residual") {
  Setup setup = paper(10, 1e-2);
  setup.parameters.friction = FrictionLaw::coulomb;
  setup.parameters.mu_c = 0;
  const PointResult r = solve(setup, Loading{0.5});
  CHECK(r.status == PointStatus::undefined);
  CHECK(std::isnan(r.R_x_norm.value));
  CHECK(r.value[R_N] > 0);
  CHECK(r.value[R_X] == 0);
  CHECK(r.value[ENERGY_RESIDUAL] < 1e-3);
}

TEST_CASE("a list of azimuths is averaged with equal weights") {
  Setup i = paper(10);
  i.orientation.sampling = Sampling::list;
  i.orientation.theta_0 = {0.5, 2.5};
  EnsembleMean mean(i, 0.5, make_runner(Engine::reference));
  const Ensemble e = mean.full();
  const std::vector<Passage>& seen = mean.passages();
  REQUIRE(seen.size() == 2);
  CHECK(e.mean[R_N] == Approx((seen[0].end[NORMAL] + seen[1].end[NORMAL]) / 10));
  CHECK(e.error[R_N] == 0);
}

TEST_CASE("comparing with a target load needs fewer passages, which a later precise mean reuses") {
  const Setup setup = paper(50);
  EnsembleMean mean(setup, 0.62, make_runner(Engine::fast));
  const Ensemble decision = mean.rough_load(1.0);
  CHECK(decision.error[R_N] <= std::abs(decision.mean[R_N] - 1.0) / 4);
  const Ensemble all = mean.full();
  CHECK(decision.passages < all.passages / 2);
  CHECK(mean.passages().size() == std::size_t(all.passages));
  std::vector<double> theta_0;
  for (const Passage& p : mean.passages()) theta_0.push_back(p.theta_0);
  std::sort(theta_0.begin(), theta_0.end());
  CHECK(std::adjacent_find(theta_0.begin(), theta_0.end()) == theta_0.end());
}

TEST_CASE("the load of a gap stays what it was when its reported values were computed") {
  const Setup setup = paper(50);
  for (const double z_0 : {0.6, 0.62, 0.64, 0.66}) {
    EnsembleMean mean(setup, z_0, make_runner(Engine::fast));
    const double R_n = mean.full().mean[R_N];
    CHECK(mean.precise_load(R_n).mean[R_N] == R_n);
    CHECK(mean.rough_load(R_n).mean[R_N] == R_n);
    CHECK(mean.with_integrator_error().mean[R_N] == R_n);
  }
}

TEST_CASE("both engines agree on a point within the errors of integrator and quadrature") {
  for (const double k_r : {5.0, 30.0}) {
    const Setup setup = paper(k_r, 3e-3);
    const PointResult fast = solve(setup, Loading{}),
                      reference = solve_point(setup, Loading{}, make_runner(Engine::reference));
    CAPTURE(k_r);
    for (const Observable k : {N_C_RATIO, R_N, R_X, GAMMA_1, GAMMA_2, GAMMA_3})
      CHECK(std::abs(fast.value[k] - reference.value[k]) <=
            fast.error[k] + reference.error[k] + 1e-4 * std::abs(fast.value[k]));
  }
}

TEST_CASE("an ensemble with an incomplete passage has status incomplete and no values") {
  Setup i = paper(10);
  i.integrator.max_evaluations = 5000;
  const PointResult r = solve(i, Loading{0.3, 0, LoadPath::loading});
  CHECK(r.status == PointStatus::incomplete);
  CHECK(std::isnan(r.R_x_norm.value));
  CHECK(std::isfinite(r.incomplete_theta_0));
}

TEST_CASE("a point with a target load carries this load within its error and the tolerance") {
  const PointResult r = solve(paper(30, 3e-3), Loading{});
  CHECK(r.status == PointStatus::ok);
  CHECK(std::abs(r.value[R_N] - 2) <= 2 * 3e-3 * 2);
  CHECK(r.R_x_norm.value == Approx(r.value[R_X] / rigid_friction(paper(30).parameters, r.value[R_N])));
  CHECK(r.z_0_error > 0);
  const PointResult same = solve(paper(30, 3e-3), Loading{r.z_0, 0, LoadPath::loading});
  // The values are those at the reported gap. The quadrature nodes differ, as the load search added some.
  for (const Observable k : {N_C_RATIO, R_N, R_X, GAMMA_1, GAMMA_2, GAMMA_3})
    CHECK(std::abs(same.value[k] - r.value[k]) <= 2 * (same.error[k] + r.error[k]));
}

TEST_CASE("values are moved to the target load: they carry it, and no share or number becomes negative") {
  // At the first point the load turns out to be uneven after a gap has been accepted, at the second the
  // secants of the number of impacts, which is nearly zero, pass below zero.
  for (const auto& [k_r, k_theta] : {std::pair(34.116430921009496, 1.6366784343505556),
                                     {9.243744909245455, 0.3822824957109401},
                                     {10., 1.}}) {
    CAPTURE(k_r, k_theta);
    Setup setup = paper(k_r);
    setup.parameters.k_theta = k_theta;
    setup.integrator = {1e-4, 2e-4};
    const PointResult r = solve(setup, Loading{});
    CHECK((r.status == PointStatus::ok || r.status == PointStatus::ambiguous));
    CHECK(r.value[R_N] == Approx(2).epsilon(setup.orientation.rtol));
    CHECK(r.value[observable("impacts")] >= 0);
    CHECK(r.value[observable("off_slab_share")] >= 0);
    if (k_r != 10) continue;
    setup.orientation.rtol = 1e-4;
    setup.integrator = {1e-5, 2e-5};
    const PointResult fine = solve(setup, Loading{});
    CHECK(std::abs(r.z_0 - fine.z_0) <= 2 * (r.z_0_error + fine.z_0_error));
    for (const Observable k : {R_X, N_C_RATIO, GAMMA_1, GAMMA_2, GAMMA_3})
      CHECK(std::abs(r.value[k] - fine.value[k]) <= 2 * (r.error[k] + fine.error[k]));
  }
}

TEST_CASE("load control on the model: loading and unloading paths differ where R_n(z_0) folds") {
  const Setup i = paper(27, 1e-2);
  Loading loading, unloading;
  unloading.path = LoadPath::unloading;
  const PointResult down = solve(i, loading), up = solve(i, unloading);
  CHECK(down.z_0 > 0.55);
  CHECK(up.z_0 < 0.25);
  for (const PointResult& r : {down, up}) CHECK(r.value[R_N] == Approx(2).epsilon(1e-2));
  CHECK(up.R_x_norm.value > 3 * down.R_x_norm.value);
}

TEST_CASE("rigid friction: Eqs. (22, 23)") {
  Parameters p;
  CHECK(rigid_friction(p, 2) == Approx(3e4 * M_PI * std::pow(3.0 / 17 / (4 * 5.849e4) * 2, 2.0 / 3)));
  p.friction = FrictionLaw::coulomb;
  p.mu_c = 0.7;
  CHECK(rigid_friction(p, 2) == Approx(1.4));
}

}  // namespace bristle::ensemble_test
