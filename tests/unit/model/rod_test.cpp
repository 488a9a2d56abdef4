#include "bristle/dynamics/rules.hpp"
#include "bristle/dynamics/trajectory.hpp"
#include "bristle/ensemble/point.hpp"
#include "generators.hpp"
#include "bristle/model/equilibrium.hpp"
#include "bristle/simd/runner.hpp"

#include <Eigen/Geometry>

namespace bristle::rod_test {
using namespace testing;
using namespace component;

namespace {

Eigen::Vector3d vector(const Vector3<double>& v) { return {v[0], v[1], v[2]}; }

Parameters random_rod() {
  Parameters p = random_parameters();
  p.bending = Bending::rod;
  return p;
}

Parameters default_rod() {
  Parameters p;
  p.bending = Bending::rod;
  p.section = Section::oval;
  p.C = chi_C_peak_at_V_s(p.A);
  return p;
}

// The direction of the undeformed bristle.
Eigen::Vector3d undeformed(const Bristle<double>& b) { return vector(state_at_rest(b, {1, b.phi_0}).r); }

RodAngles<double> angles_at(const Bristle<double>& b, const Vector3<double>& position) {
  return rod_angles(b, position, 1 / vector(position).norm());
}

double bending_energy(const Bristle<double>& b, const Vector3<double>& position) {
  const RodAngles<double> rod = angles_at(b, position);
  return b.k_phi * rod.u_p * rod.u_p / 2 + b.k_theta * rod.u_s * rod.u_s / 2;
}

Eigen::Vector3d acceleration_at_rest(const Bristle<double>& b, const Vector3<double>& position) {
  return vector(motion(b, State<double>{position, {0, 0, 0}, b.theta_0, b.phi_0}).acceleration);
}

Passage pass(const Parameters& p, double z_0, double theta_0, Engine engine) {
  const auto b = make_bristle(p, z_0, theta_0);
  IntegratorOptions options;
  options.rtol = 1e-9;
  options.atol = 1e-10;
  return make_runner(engine)({{&p, b, static_equilibrium(b), options}}).front();
}

}  // namespace

TEST_CASE("the angle over its sine, and its derivative, at every angle") {
  CHECK(angle_over_sine(0.).value == 1);
  CHECK(angle_over_sine(0.).slope == Approx(-1. / 3).epsilon(1e-15));
  for (const double angle : {1e-6, 1e-3, 0.1, 0.7, M_PI / 2, 2.5, 3.0, 3.14}) {
    CAPTURE(angle);
    const double versed = 2 * std::sin(angle / 2) * std::sin(angle / 2), c = 1 - versed;
    const double g = angle / std::sin(angle);
    CHECK(angle_over_sine(versed).value == Approx(g).epsilon(angle < 3 ? 1e-12 : 1e-10));
    if (angle > 0.05)  // the formula cancels below
      CHECK(angle_over_sine(versed).slope == Approx((c * g - 1) / (1 - c * c)).epsilon(1e-9));
  }
}

TEST_CASE("rod: the two bending angles make up the angle between the bristle and its undeformed direction") {
  rc::prop("for any position", [] {
    const auto b = make_bristle(random_rod(), 0.6, uniform(-3, 3));
    const Vector3<double> at = random_state(0.6).r;
    const RodAngles<double> rod = angles_at(b, at);
    const double gamma = std::atan2(undeformed(b).cross(vector(at)).norm(), undeformed(b).dot(vector(at)));
    RC_ASSERT(std::abs(std::hypot(rod.u_p, rod.u_s) - gamma) < 1e-12);
  });
}

TEST_CASE("rod: with k_theta = k_phi the energy of bending is k_phi gamma^2/2, whatever the direction") {
  rc::prop("for any position", [] {
    Parameters p = random_rod();
    p.k_theta = p.k_phi;
    const auto b = make_bristle(p, 0.6, uniform(-3, 3));
    const Vector3<double> at = random_state(0.6).r;
    const double gamma = std::acos(undeformed(b).dot(vector(at).normalized()));
    RC_ASSERT(std::abs(bending_energy(b, at) - p.k_phi * gamma * gamma / 2) < 1e-7);
  });
}

TEST_CASE("rod: the vertical is a direction like any other") {
  const auto b = make_bristle(default_rod(), 0.6, 2.);
  const Eigen::Vector3d at_pole = acceleration_at_rest(b, {0, 0, 0.5}),
                        beside = acceleration_at_rest(b, {1e-9, -1e-9, 0.5});
  CHECK((at_pole - beside).norm() < 1e-7 * at_pole.norm());
  CHECK(std::isfinite(motion(b, State<double>{{0, 0, 0.5}, {1, 2, 3}, 0, 0}).acceleration[0]));
}

TEST_CASE("rod and polar springs are the same in the plane theta = theta_0") {
  rc::prop("for any position in the plane away from the pole", [] {
    Parameters p = random_parameters();
    p.zeta_theta = 0;  // its damping has other units
    p.alpha = 0;
    const double phi = uniform(0.1, 1.5), theta_0 = uniform(-3, 3), r = uniform(0.3, 2);
    p.bending = Bending::polar;
    const auto polar = make_bristle(p, 3, theta_0);  // the slab is far above
    p.bending = Bending::rod;
    const auto rod = make_bristle(p, 3, theta_0);
    State<double> s = state_at_rest(polar, {r, phi});
    const double along_s = uniform(-1, 1);
    s.v = {along_s * std::cos(theta_0), along_s * std::sin(theta_0), uniform(-1, 1)};
    const Eigen::Vector3d difference =
        vector(motion(polar, s).acceleration) - vector(motion(rod, s).acceleration);
    RC_ASSERT(difference.norm() < 1e-10 * (1 + vector(motion(rod, s).acceleration).norm()));
    RC_ASSERT(std::abs(energy(polar, s) - energy(rod, s)) < 1e-10 * (1 + energy(rod, s)));
  });
}

TEST_CASE("rod and polar springs agree to first order where k_theta of the rod is k_theta/cos^2 phi_0") {
  rc::prop("for small deflections in any direction", [] {
    Parameters p = random_parameters();
    p.alpha = 0;
    p.friction = FrictionLaw::coulomb;
    p.mu_c = p.zeta_phi = p.zeta_theta = 0;
    p.bending = Bending::polar;
    p.section = Section::oval;
    const double theta_0 = uniform(-3, 3);
    const auto polar = make_bristle(p, 2, theta_0);  // the slab is far above
    p.bending = Bending::rod;
    p.k_theta /= std::cos(p.phi_0) * std::cos(p.phi_0);
    const auto rod = make_bristle(p, 2, theta_0);
    State<double> s = state_at_rest(polar, {1, p.phi_0});
    constexpr double small = 1e-5;
    for (double& x : s.r) x += small * uniform(-1, 1);
    s.theta = std::atan2(s.r[1], s.r[0]);
    s.phi = std::asin(s.r[2] / vector(s.r).norm());
    const Eigen::Vector3d expected = vector(motion(polar, s).acceleration);
    RC_ASSERT((vector(motion(rod, s).acceleration) - expected).norm() < 1e-3 * (expected.norm() + small));
  });
}

TEST_CASE("rod: damping is that of a unit mass at r = 1, in both directions") {
  Parameters p = default_rod();
  p.k_theta = 4;
  p.k_phi = 2.25;
  const auto b = make_bristle(p, 0.5, 0);
  CHECK(b.c_theta == Approx(2 * 0.1 * 2));
  CHECK(b.c_phi == Approx(2 * 0.1 * 1.5));
}

TEST_CASE("rod: a bristle that points against the motion is driven over and leaves") {
  Parameters p = default_rod();
  p.k_r = 50;
  p.k_theta = p.k_phi;
  for (const Engine engine : {Engine::fast, Engine::reference})
    for (const double degrees : {179., 179.9, 180.}) {
      CAPTURE(degrees);
      const Passage r = pass(p, 0.62, degrees * M_PI / 180, engine);
      CHECK(r.outcome == Outcome::left);
      CHECK(r.reflections == 0);
      CHECK(r.energy_residual < 1e-6);
    }
}

TEST_CASE(
    "rod: a tip that is pushed to the base, where its dampers are stiff, takes a bounded number of steps") {
  Parameters p = default_rod();
  p.k_theta = 0.3;
  for (const double z_0 : {0.01, 0.02, 0.03})
    for (const double degrees : {179., 180.}) {
      CAPTURE(z_0, degrees);
      const auto b = make_bristle(p, z_0, degrees * M_PI / 180);
      const IntegratorOptions options = {3e-5, 6e-5, Method::automatic, 100'000};
      CHECK(make_runner(Engine::fast)({{&p, b, static_equilibrium(b), options}}).front().outcome ==
            Outcome::left);
    }
}

TEST_CASE("rod: the values of an independent computation") {
  // docs/model.md: the mean over twelve azimuths.
  Setup setup;
  Parameters& p = setup.parameters;
  p = default_rod();
  p.k_theta = p.k_phi;
  setup.orientation.sampling = Sampling::list;
  for (int i = 0; i < 12; ++i) setup.orientation.theta_0.push_back((7.5 + 15 * i) * M_PI / 180);
  setup.integrator.rtol = 1e-9;
  setup.integrator.atol = 1e-10;
  Loading loading;
  loading.z_0 = 0.3;
  for (const Engine engine : {Engine::fast, Engine::reference}) {
    const PointResult point = solve_point(setup, loading, make_runner(engine));
    CHECK(point.value[R_N] == Approx(1.3289).margin(1e-4));
    CHECK(point.value[R_X] == Approx(5.979).margin(1e-3));
    CHECK(point.value[N_C_RATIO] == Approx(1.2638).margin(1e-4));
    CHECK(point.value[GAMMA_1] == Approx(0.6451).margin(1e-4));
    CHECK(point.value[GAMMA_2] == Approx(0.8856).margin(1e-4));
    CHECK(point.value[GAMMA_3] == Approx(0.9325).margin(1e-4));
    CHECK(point.value[ENERGY_RESIDUAL] < 1e-9);
  }
}

TEST_CASE("rod: recorded trajectories have the azimuth and the polar angle of the tip") {
  const Parameters p = default_rod();
  const auto b = make_bristle(p, 0.4, 3.);
  const Trajectory t = record_trajectory({&p, b, static_equilibrium(b), {}});
  CHECK(t.points.front().y[THETA] == 3.);
  double last = 3;
  for (const TrajectoryPoint& point : t.points) {
    const OdeState& y = point.y;
    CHECK(std::abs(std::remainder(y[THETA] - std::atan2(y[Y], y[X]), 2 * M_PI)) < 1e-9);
    CHECK(y[PHI] == Approx(std::atan2(y[Z], std::hypot(y[X], y[Y]))).margin(1e-12));
    CHECK(std::abs(y[THETA] - last) < 3.15);
    last = y[THETA];
  }
}

}  // namespace bristle::rod_test
