#include "bristle/dynamics/trajectory.hpp"
#include "bristle/ensemble/point.hpp"
#include "generators.hpp"
#include "bristle/model/equilibrium.hpp"
#include "bristle/simd/runner.hpp"

namespace bristle::contact_test {
using namespace testing;
using namespace component;

namespace {

Parameters hertz_rod() {
  Parameters p;
  p.bending = Bending::rod;
  p.contact = Contact::hertz;
  p.k_r = 30;
  p.C = chi_C_peak_at_V_s(p.A);
  return p;
}

Passage pass(const Parameters& p, double z_0, double theta_0, Engine engine) {
  const auto b = make_bristle(p, z_0, theta_0);
  IntegratorOptions options;
  options.rtol = 1e-9;
  options.atol = 1e-10;
  return make_runner(engine)({{&p, b, static_equilibrium(b), options}}).front();
}

}  // namespace

TEST_CASE(
    "contact: F_n is the derivative of the energy by the height, and its own derivative the stiffness") {
  rc::prop("for both laws, on the slab and off it", [] {
    const Parameters p = random_parameters();
    const auto b = make_bristle(p, 0.6, 0);
    const double z = 0.6 + uniform(-3e-3, 2e-2), h = 1e-7;
    const double F_n = contact_force(b, z).F_n;
    const double slope = (contact_energy(b, z + h) - contact_energy(b, z - h)) / (2 * h);
    const double stiffness = (contact_force(b, z + h).F_n - contact_force(b, z - h).F_n) / (2 * h);
    RC_ASSERT(std::abs(slope - F_n) <= 1e-5 * F_n + 1e-3);
    RC_ASSERT(std::abs(stiffness - contact_stiffness(b, z)) <= 1e-4 * stiffness + 20);
    RC_ASSERT(F_n >= 0);
  });
}

TEST_CASE("contact: Hertz's force is 0 off the slab and (4/3) E* R_c^(1/2) depth^(3/2) on it") {
  const Parameters p = hertz_rod();
  const auto b = make_bristle(p, 0.6, 0);
  CHECK(contact_force(b, 0.6).F_n == 0);
  CHECK(contact_force(b, 0.5).F_n == 0);
  CHECK(contact_energy(b, 0.5) == 0);
  CHECK(contact_stiffness(b, 0.5) == 0);
  for (const double depth : {1e-12, 1e-5, 1e-3, 0.02}) {
    CAPTURE(depth);
    const auto force = contact_force(b, 0.6 + depth);
    const double d = 0.6 + depth - 0.6;  // as rounded
    CHECK(force.F_n == Approx(4. / 3 * p.E_star * std::sqrt(p.R_c) * std::pow(d, 1.5)).epsilon(1e-13));
    CHECK(force.F_n_23 == Approx(std::pow(force.F_n, 2. / 3)).epsilon(1e-13));
    CHECK(contact_energy(b, 0.6 + depth) ==
          Approx(8. / 15 * p.E_star * std::sqrt(p.R_c) * std::pow(d, 2.5)).epsilon(1e-13));
    // Eq. (10): the contact's area is pi R_c depth, that of the sphere's section.
    CHECK(hertz_area_factor(p.R_c, p.E_star) * force.F_n_23 == Approx(M_PI * p.R_c * d).epsilon(1e-13));
  }
}

TEST_CASE("contact: with Hertz the energy budget closes, with both engines") {
  rc::prop("for random bristles that conserve energy", [] {
    Parameters p = random_conserving_parameters();
    p.contact = Contact::hertz;
    const double z_0 = uniform(0.1, 0.97), theta_0 = uniform(-2.9, 2.9);
    for (const Engine engine : {Engine::fast, Engine::reference}) {
      const Passage r = pass(p, z_0, theta_0, engine);
      RC_PRE(r.complete());
      RC_ASSERT(r.energy_residual < 1e-5);
    }
  });
}

TEST_CASE("contact: the values of an independent computation with Hertz") {
  // docs/model.md: the mean over twelve azimuths.
  Setup setup;
  setup.parameters = hertz_rod();
  setup.orientation.sampling = Sampling::list;
  for (int i = 0; i < 12; ++i) setup.orientation.theta_0.push_back((7.5 + 15 * i) * M_PI / 180);
  setup.integrator.rtol = 1e-9;
  setup.integrator.atol = 1e-10;
  Loading loading;
  loading.z_0 = 0.55;
  for (const Engine engine : {Engine::fast, Engine::reference}) {
    const PointResult point = solve_point(setup, loading, make_runner(engine));
    CHECK(point.value[R_N] == Approx(2.1699).margin(1e-3));
    CHECK(point.value[R_X] == Approx(1.9186).margin(1e-3));
    CHECK(point.value[N_C_RATIO] == Approx(1.1918).margin(1e-3));
    CHECK(point.value[GAMMA_1] == Approx(0.3014).margin(1e-3));
    CHECK(point.value[GAMMA_2] == Approx(0.163).margin(1e-3));
    CHECK(point.value[GAMMA_3] == Approx(0.4771).margin(1e-3));
    CHECK(point.value[observable("off_slab_share")] == Approx(0.798).margin(1e-3));
    CHECK(point.value[observable("F_n_peak")] == Approx(65.1).margin(0.3));
    CHECK(point.value[ENERGY_RESIDUAL] < 1e-6);
  }
}

TEST_CASE("contact: with Hertz first contact is at sin(phi_0), where no tip carries a load") {
  const Parameters p = hertz_rod();
  for (const Engine engine : {Engine::fast, Engine::reference}) {
    const Passage at = pass(p, sin(p.phi_0), 1, engine), below = pass(p, sin(p.phi_0) - 1e-4, 1, engine);
    CHECK(at.outcome == Outcome::left);
    CHECK(at.end[NORMAL] < kNoLoad);
    CHECK(at.contact_time == Approx(p.L_x));
    CHECK(at.gamma_1 == Approx(1).margin(2e-3));
    CHECK(at.gamma_2 == 1);
    CHECK(at.gamma_3 == 1);
    CHECK(below.end[NORMAL] > kNoLoad);
  }
  Setup setup;
  setup.parameters = p;
  setup.orientation.sampling = Sampling::list;
  setup.orientation.theta_0 = {1};
  Loading loading;
  loading.z_0 = sin(p.phi_0);
  CHECK(solve_point(setup, loading, make_runner(Engine::fast)).status == PointStatus::undefined);
}

TEST_CASE("contact: k_theta of a round rod is k_phi, and a polar bristle keeps its own") {
  Parameters p = hertz_rod();
  p.k_theta = 7;
  CHECK(make_bristle(p, 0.5, 0).k_theta == p.k_phi);
  p.section = Section::oval;
  CHECK(make_bristle(p, 0.5, 0).k_theta == 7);
  p.section = Section::round;
  p.bending = Bending::polar;
  CHECK(make_bristle(p, 0.5, 0).k_theta == 7);
}

}  // namespace bristle::contact_test
