// Scatter within a brush: bristles that differ share one gap.
#include "bristle/ensemble/brush_mean.hpp"
#include "bristle/ensemble/lattice.hpp"
#include "experiment/experiment.hpp"
#include "sweep/si.hpp"
#include "ensembles.hpp"

#include "catch.hpp"
#include <cmath>
#include <numeric>
#include <random>

namespace bristle::scatter_test {
using namespace testing;

namespace {

const std::string kExperiments = BRISTLE_EXPERIMENTS;

Scatter scatter_of(Deviations width, bool uniform = false) {
  Scatter out;
  out.width = width;
  out.uniform.fill(uniform);
  return out;
}

Setup brush(double k_r, Deviations width) {
  Setup out = paper(k_r);
  out.parameters.bending = Bending::rod;
  out.integrator = {1e-4, 2e-4};
  out.scatter = scatter_of(width);
  return out;
}

// The mean of the property's deviation to this power over the bristles that stand for the brush.
double moment(const std::vector<Deviations>& all, std::size_t property, int power) {
  double sum = 0;
  for (const Deviations& one : all) sum += std::pow(one[property], power);
  return sum / double(all.size());
}

}  // namespace

TEST_CASE("the bristles of a brush with scatter have its mean, spread and symmetry") {
  for (const bool uniform : {false, true}) {
    CAPTURE(uniform);
    const Scatter scatter = scatter_of({0.02, 0.05, 0, 0.01}, uniform);
    const std::vector<Deviations> all = representative_deviations(scatter);
    REQUIRE(all.size() == 16);
    for (std::size_t i = 0; i < kScattered.size(); ++i) {
      const double variance = scatter.width[i] * scatter.width[i] * (uniform ? 1. / 3 : 1);
      CHECK(moment(all, i, 2) == Approx(variance));
      CHECK(std::abs(moment(all, i, 1)) < 1e-17);
      CHECK(std::abs(moment(all, i, 3)) < 1e-17);
    }
    for (std::size_t i = 0; i < all.size(); i += 2) CHECK(all[i][0] == -all[i + 1][0]);
  }
}

TEST_CASE("each bristle of a lattice has its own deviation, within five standard deviations") {
  const Scatter scatter = scatter_of({0.02, 0, 0, 0.01});
  double sum = 0, squares = 0, cross = 0;
  constexpr int n = 100000;
  for (std::uint64_t i = 0; i < n; ++i) {
    const Deviations one = random_deviations(scatter, 3, i);
    REQUIRE(std::abs(one[0]) <= 0.1);
    REQUIRE(one[1] == 0);
    sum += one[0] / 0.02;
    squares += one[0] * one[0] / 0.02 / 0.02;
    cross += one[0] * one[3] / 0.02 / 0.01;
  }
  const double five_errors = 5 / std::sqrt(double(n));
  CHECK(std::abs(sum / n) < five_errors);
  CHECK(std::abs(squares / n - 1) < std::sqrt(2.) * five_errors);
  CHECK(std::abs(cross / n) < five_errors);
  CHECK(random_deviations(scatter, 3, 7) == random_deviations(scatter, 3, 7));
  CHECK(random_deviations(scatter, 3, 7) != random_deviations(scatter, 4, 7));
}

TEST_CASE("the error of the scatter leaves out what is exact, and covers the rest") {
  Scatter scatter = scatter_of({0.1, 0.2, 0, 0});
  const std::vector<Deviations> all = representative_deviations(scatter);
  std::vector<double> values;
  for (const Deviations& d : all)
    values.push_back(3 + 2 * d[0] - d[1] + 5 * d[0] * d[0] + d[1] * d[1] * d[1]);
  CHECK(scatter_error(all, values) < 1e-14);
  // A step between 40 and 60 % of the distribution, as where bristles begin to bounce: its mean is the share
  // of the distribution beyond it.
  const auto deviation = [&](double step, long bristles) {
    scatter.bristles = bristles;
    const std::vector<Deviations> at = representative_deviations(scatter);
    std::vector<double> steps;
    for (const Deviations& d : at) steps.push_back(d[0] > step * 0.1 ? 1 : 0);
    const double mean = std::accumulate(steps.begin(), steps.end(), 0.0) / double(bristles);
    return std::pair(std::abs(mean - std::erfc(step / std::sqrt(2.)) / 2), scatter_error(at, steps));
  };
  for (const long bristles : {16, 64})
    for (double step = 0.3; step < 2; step += 0.1) {
      CAPTURE(bristles, step);
      const auto [distance, error] = deviation(step, bristles);
      CHECK(distance <= 2 * error);
    }
}

TEST_CASE("a bristle that deviates is the bristle of the SI block with other length, radius and modulus") {
  const auto brush = [](double length, double radius, double modulus) {
    return experiment::load_experiment(
               kExperiments + "/ski.json",
               {{"/si/m_kg=null", "/si/rho_kg_per_m3=1100", "/sweep=null", "/si/V0_m_per_s=10",
                 fmt::format("/si/r0_m={}", 0.017 * length), fmt::format("/si/R_m={}", 0.00108 * radius),
                 fmt::format("/si/E_Pa={}", 1e8 * modulus), "/si/spacing_m=0.004", "/model/friction=\"nss\"",
                 "/si/R_n_N=0.6", "/si/L_x_m=0.085", "/si/L_y_m=0.085"},
                "full"})
        .sweep.point(0);
  };
  const sweep::PointInput nominal = brush(1, 1, 1), other = brush(1.1, 0.95, 1.2);
  const DeviatingBristle bristle = deviating(nominal.setup.parameters, {0.1, -0.05, 0.2, 0});
  for (const Parameter& one : kParameters)
    if (one.member != &Parameters::lambda_z && one.member != &Parameters::beta) {  // Hertz's contact has none
      CAPTURE(one.name);
      CHECK(bristle.parameters.*one.member == Approx(other.setup.parameters.*one.member).epsilon(1e-12));
    }
  const SiScales a = sweep::si_scales(nominal), b = sweep::si_scales(other);
  for (const auto unit : {&SiScales::length, &SiScales::velocity, &SiScales::energy, &SiScales::force,
                          &SiScales::stiffness, &SiScales::stress})
    CHECK(bristle.unit.*unit == Approx(b.*unit / (a.*unit)).epsilon(1e-12));
}

TEST_CASE("the mean over a brush is that of its bristles, each computed alone") {
  const Setup setup = brush(25, {0.03, 0.02, 0.05, 0.01});
  constexpr double z_0 = 0.7;
  const PointResult all = solve(setup, {.z_0 = z_0});
  ObservableArray mean{};
  double largest = 0;
  for (const Deviations& by : representative_deviations(setup.scatter)) {
    Setup one = setup;
    one.scatter = {};
    const DeviatingBristle bristle = deviating(setup.parameters, by);
    one.parameters = bristle.parameters;
    const PointResult alone = solve(one, {.z_0 = z_0 / bristle.unit.length});
    for (Observable k = 0; k < OBSERVABLES; ++k)
      mean[k] += alone.value[k] * units_of(bristle)[k] / double(setup.scatter.bristles);
    largest = std::max(largest, alone.value[R_N]);
  }
  for (Observable k = 0; k < OBSERVABLES; ++k)
    CHECK(all.value[k] == Approx(mean[k]).epsilon(1e-12).margin(1e-12));
  CHECK(largest > 1.02 * mean[R_N]);
  CHECK(all.status == PointStatus::ok);
}

TEST_CASE("a brush with scatter carries the load, on both paths, and on its lattice") {
  Setup setup = brush(40, {0.03, 0, 0.05, 0});
  const PointResult point = solve(setup, {.R_n = 1});
  CHECK(point.status == PointStatus::ok);
  CHECK(point.value[R_N] == Approx(1).epsilon(1e-3));
  CHECK(point.error[R_X] < 0.1 * point.value[R_X]);
  setup.parameters.L_y = 20;
  setup.orientation.sampling = Sampling::lattice;
  setup.orientation.rows = 400;
  setup.orientation.t_1 = -1;
  const PointResult lattice = solve(setup, {.z_0 = point.z_0}), mean = point;
  for (const Observable k : {R_N, R_X, GAMMA_1, GAMMA_3}) {
    CAPTURE(k, lattice.value[k], lattice.error[k], mean.value[k], mean.error[k]);
    CHECK(std::abs(lattice.value[k] - mean.value[k]) < 3 * (lattice.error[k] + mean.error[k]));
  }
  CHECK(lattice.status == PointStatus::ok);
}

}  // namespace bristle::scatter_test
