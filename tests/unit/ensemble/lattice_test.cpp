// Appendix A of the paper: random azimuths, the force on the slab over time, and its standard errors.
#include "bristle/dynamics/trajectory.hpp"
#include "bristle/ensemble/lattice.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/special_functions/bessel.hpp>
#include "bristle/model/friction/laws.hpp"

#include "catch.hpp"
#include <cmath>
#include <numeric>

namespace bristle::lattice_test {

namespace {

Setup lattice(long rows, double L_y, std::uint64_t seed) {
  Setup i;
  i.parameters.C = chi_C_peak_at_V_s(i.parameters.A);
  i.parameters.L_y = L_y;
  i.orientation.sampling = Sampling::lattice;
  i.orientation.rows = rows;
  i.orientation.seed = seed;
  i.orientation.t_1 = -1;
  i.integrator = {1e-5, 1e-7};
  return i;
}

const PassageRunner& fast() {
  static const PassageRunner run = make_runner(Engine::fast);
  return run;
}

// p-value of the chi-squared test for equal expected counts.
double p_uniform(const std::vector<long>& counts) {
  const double expected = double(std::accumulate(counts.begin(), counts.end(), 0L)) / double(counts.size());
  double statistic = 0;
  for (const long n : counts) statistic += (double(n) - expected) * (double(n) - expected) / expected;
  const boost::math::chi_squared distribution(double(counts.size() - 1));
  return cdf(complement(distribution, statistic));
}

}  // namespace

TEST_CASE("azimuths: uniform, functions of seed and index, independent between neighbours and seeds") {
  Orientation o;
  o.seed = 7;
  std::vector<long> bins(64), pairs(64), seeds(64);
  const auto bin = [](double angle, int n) { return int((angle + M_PI) / (2 * M_PI) * n); };
  for (std::uint64_t i = 0; i < 64000; ++i) {
    const double angle = random_azimuth(o, i), next = random_azimuth(o, i + 1);
    REQUIRE(std::abs(angle) <= M_PI);
    Orientation other = o;
    other.seed = 8;
    ++bins[std::size_t(bin(angle, 64))];
    ++pairs[std::size_t(8 * bin(angle, 8) + bin(next, 8))];
    ++seeds[std::size_t(8 * bin(angle, 8) + bin(random_azimuth(other, i), 8))];
  }
  CHECK(p_uniform(bins) > 1e-3);
  CHECK(p_uniform(pairs) > 1e-3);
  CHECK(p_uniform(seeds) > 1e-3);
  // The same bits on every machine, as these are multiples of 2 pi/2^53.
  CHECK(random_azimuth(o, 0) == random_azimuth(o, 0));
  CHECK(random_azimuth(o, 0) != random_azimuth(o, 1));
}

TEST_CASE("azimuths: von Mises draws have the mean resultant I_1/I_0 and their own mean") {
  for (const double kappa : {0.5, 3.0, 40.0}) {
    Orientation o;
    o.distribution = Distribution::von_mises;
    o.concentration = kappa;
    o.mean = 2;
    double c = 0, s = 0;
    const int n = 40000;
    for (int i = 0; i < n; ++i) {
      const double angle = random_azimuth(o, std::uint64_t(i));
      c += std::cos(angle - o.mean) / n;
      s += std::sin(angle - o.mean) / n;
    }
    CAPTURE(kappa);
    CHECK(c ==
          Approx(boost::math::cyl_bessel_i(1, kappa) / boost::math::cyl_bessel_i(0, kappa)).margin(0.01));
    CHECK(std::abs(s) < 0.01);
  }
}

TEST_CASE("the time mean over the lattice is the ensemble mean within its standard error, over seeds") {
  Setup mean = lattice(90, 5, 0);
  mean.orientation.sampling = Sampling::quadrature;
  const Ensemble expected = EnsembleMean(mean, 0.115, fast()).full();
  for (const Observable k : {R_N, R_X, N_C_RATIO, GAMMA_1}) {
    double squares = 0;
    const int seeds = 8;
    for (int seed = 1; seed <= seeds; ++seed) {
      const LatticeMean l = lattice_mean(lattice(90, 5, std::uint64_t(seed)), 0.115, fast());
      REQUIRE(l.incomplete == 0);
      const double units = (l.mean[k] - expected.mean[k]) / l.error[k];
      squares += units * units / seeds;
    }
    CAPTURE(k, squares);
    CHECK(squares < 2.75);  // chi-squared with 8 degrees of freedom: exceeded with probability 1/200
    CHECK(squares > 0.15);  // smaller values mean that the errors are overestimated
  }
}

TEST_CASE("R_n(t): the time average equals the mean, and a shorter lattice gives the same beginning") {
  const Setup i = lattice(70, 2, 3);
  const LatticeMean l = lattice_mean(i, 0.3, fast());
  const auto from = l.force.R_n.begin() + std::lround(lattice_start(i) / l.force.interval);
  const auto mean = std::accumulate(from, l.force.R_n.end(), 0.0) / double(l.force.R_n.end() - from);
  CHECK(mean == Approx(l.mean[R_N]).epsilon(1e-12));
  CHECK(l.force.R_n.size() == 280);
  CHECK(l.passages.size() == 700);
  CHECK(l.force.N_c.front() == Approx(1.0 / 25));  // one row of 25
  const LatticeMean shorter = lattice_mean(lattice(60, 2, 3), 0.3, fast());
  CHECK(std::equal(shorter.force.R_n.begin(), shorter.force.R_n.end(), l.force.R_n.begin()));
}

TEST_CASE(
    "sampled integrals: both engines agree along the passage, and sampling does not change the passage") {
  Parameters p;
  p.C = chi_C_peak_at_V_s(p.A);
  for (const double degrees : {20.0, 100.0, 170.0, 179.5}) {
    const auto b = make_bristle(p, 0.115, degrees * M_PI / 180);
    PassageTask task{&p, b, static_equilibrium(b), {1e-7, 1e-9}};
    const Passage plain = fast()({task}).front();
    task.sample_interval = 0.05;
    const Passage sampled = fast()({task}).front(), reference = run_passage(task);
    CAPTURE(degrees);
    CHECK(sampled.end == plain.end);
    CHECK(sampled.contact_time == plain.contact_time);
    REQUIRE(sampled.samples.size() == std::size_t(std::floor(sampled.contact_time / 0.05)));
    REQUIRE(sampled.samples.size() == reference.samples.size());
    const double scale = sampled.end[component::NORMAL];
    for (std::size_t k = 0; k < sampled.samples.size(); ++k)
      REQUIRE(sampled.samples[k].normal == Approx(reference.samples[k].normal).margin(3e-3 * scale));
    CHECK(sampled.samples.back().normal <= scale);
  }
}

TEST_CASE("the phases of a trajectory agree with its forces and velocities") {
  Parameters p;
  p.k_r = 20;
  p.C = chi_C_peak_at_V_s(p.A);
  const auto b = make_bristle(p, 0.38, M_PI / 3);
  const Trajectory t = record_trajectory({&p, b, static_equilibrium(b), {1e-5, 1e-7}});
  REQUIRE(t.passage.complete());
  CHECK(t.points.front().xi == 0);
  CHECK(t.points.back().xi == t.passage.contact_time);
  CHECK(t.points.size() == std::size_t(t.passage.steps) + 1);
  long counts[4] = {};
  for (const TrajectoryPoint& at : t.points) {
    ++counts[int(at.phase)];
    if (at.phase == Phase::off_slab) CHECK(at.F_n < 0.03);
    if (at.phase == Phase::stick) CHECK(at.V_R < p.V_s);
    if (at.phase == Phase::slip) CHECK(at.F_fx > 0);
  }
  for (const long n : counts) CHECK(n > 0);
}

}  // namespace bristle::lattice_test
