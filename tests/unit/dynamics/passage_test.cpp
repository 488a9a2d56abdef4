#include "bristle/dynamics/passage.hpp"
#include "bristle/dynamics/rules.hpp"
#include "generators.hpp"

#include "catch.hpp"

namespace bristle::passage_test {
using namespace testing;
using namespace component;

namespace {

constexpr double kDegree = M_PI / 180;

Passage pass(const Parameters& p, double z_0, double theta_0, const IntegratorOptions& options = {}) {
  const auto b = make_bristle(p, z_0, theta_0);
  return run_passage({&p, b, static_equilibrium(b), options});
}

Parameters stiff_paper_point() {  // docs/model.md section 6
  Parameters p;
  p.k_r = 50;
  p.phi_0 = 81 * kDegree;
  p.C = 0;
  return p;
}

Parameters with_peak() {
  Parameters p;
  p.C = chi_C_peak_at_V_s(p.A);
  return p;
}

IntegratorOptions tolerance(double rtol, Method method = Method::automatic) {
  IntegratorOptions o;
  o.rtol = rtol;
  o.atol = rtol / 100;
  o.method = method;
  return o;
}

}  // namespace

TEST_CASE("a passage ends when the slip is L_x, up to rounding") {
  rc::prop("for any bristle", [] {
    const Parameters p = random_parameters();
    const double z_0 = uniform(0.3, 0.9);
    const auto b = make_bristle(p, z_0, uniform(-2, 2));
    const Equilibrium e = static_equilibrium(b);
    const Passage r = run_passage({&p, b, e, {}});
    RC_ASSERT(r.complete());
    const double x_0 = state_at_rest(b, e).r[0];
    RC_ASSERT(std::abs(r.contact_time - (r.end[X] - x_0) - p.L_x) < 1e-10);
  });
}

TEST_CASE("the energy budget closes within the integrator tolerance, except with Eq. (17) as printed") {
  // The residual accumulates over steps: it must decrease with the tolerance and be of its order.
  rc::prop("for any bristle", [] {
    const Parameters p = random_conserving_parameters();
    const double z_0 = uniform(0.2, 0.9), theta_0 = uniform(0, M_PI);
    const double loose = pass(p, z_0, theta_0, tolerance(1e-5)).energy_residual;
    const double tight = pass(p, z_0, theta_0, tolerance(1e-9)).energy_residual;
    RC_ASSERT(loose < 1e-3);
    RC_ASSERT(tight < 1e-6);
  });
}

TEST_CASE("with Eq. (17) as printed the energy budget does not close") {
  Parameters p = with_peak();
  p.bending = Bending::polar_as_printed;
  CHECK(pass(p, 0.5, 1.5, tolerance(1e-9)).energy_residual > 1e-3);
  p.bending = Bending::polar;
  CHECK(pass(p, 0.5, 1.5, tolerance(1e-9)).energy_residual < 1e-7);
}

TEST_CASE("mirror symmetry: theta_0 -> -theta_0 maps y to -y, bit for bit") {
  rc::prop("for any bristle", [] {
    const Parameters p = random_parameters();
    const double z_0 = uniform(0.3, 0.9), theta_0 = uniform(0.01, M_PI);
    const Passage a = pass(p, z_0, theta_0), b = pass(p, z_0, -theta_0);
    RC_ASSERT(a.contact_time == b.contact_time);
    for (const int i : {X, Z, VX, VZ, PHI, NORMAL, FRICTION_X, MODULATION, ALIGNMENT, AREA, WORK})
      RC_ASSERT(a.end[i] == b.end[i]);
    for (const int i : {Y, VY, THETA, FRICTION_Y}) RC_ASSERT(a.end[i] == -b.end[i]);
  });
}

TEST_CASE("observables converge with the tolerance") {
  const Parameters p = with_peak();
  const Passage exact = pass(p, 0.4, 2, tolerance(1e-11));
  double last = 1;
  for (const double rtol : {1e-5, 1e-7, 1e-9}) {
    const Passage r = pass(p, 0.4, 2, tolerance(rtol));
    const double error = std::abs(r.end[FRICTION_X] - exact.end[FRICTION_X]) / exact.end[FRICTION_X] +
                         std::abs(r.gamma_2 - exact.gamma_2) + std::abs(r.contact_time - exact.contact_time);
    CHECK(error < last);
    CHECK(error < 1e3 * rtol);
    last = error / 2;
  }
}

TEST_CASE("explicit and implicit methods agree on bristles that both can integrate") {
  const Parameters p = with_peak();
  for (const double degrees : {0.0, 45.0, 90.0, 135.0}) {
    const Passage a = pass(p, 0.4, degrees * kDegree, tolerance(1e-9, Method::explicit_only));
    const Passage b = pass(p, 0.4, degrees * kDegree, tolerance(1e-10, Method::implicit_only));
    CAPTURE(degrees);
    CHECK(!a.implicit);
    CHECK(b.implicit);
    CHECK(a.contact_time == Approx(b.contact_time).epsilon(1e-6));
    for (const int i : {NORMAL, FRICTION_X, MODULATION, ALIGNMENT, AREA})
      CHECK(a.end[i] == Approx(b.end[i]).epsilon(1e-5));
  }
}

TEST_CASE("a pinned bristle has outcome pinned and the values of an independent prototype") {
  const Passage r = pass(stiff_paper_point(), 0.62, 179.5 * kDegree);
  CHECK(r.outcome == Outcome::pinned);
  CHECK(r.implicit);
  CHECK(r.contact_time == Approx(5.758).margin(1e-3));
  CHECK(r.end[NORMAL] / 5 == Approx(20.77).margin(0.01));
  CHECK(r.end[FRICTION_X] / 5 == Approx(57.0).margin(0.1));
}

TEST_CASE("bristles that reach the pole are reflected and end with an outcome and values") {
  const Parameters p = stiff_paper_point();
  for (const double degrees : {179.8, 179.99, 180.0}) {
    CAPTURE(degrees);
    const Passage r = pass(p, 0.62, degrees * kDegree);
    CHECK(r.outcome == Outcome::pinned);
    CHECK(r.reflections > 0);
    CHECK(r.end[NORMAL] / 5 == Approx(20.77).margin(0.03));
    CHECK(r.energy_residual < 1e-5);
  }
}

TEST_CASE("the result of the pole rule does not depend on s_min") {
  Parameters p = stiff_paper_point();
  const Passage coarse = pass(p, 0.62, 179.99 * kDegree);
  p.s_min = 1e-5;
  const Passage fine = pass(p, 0.62, 179.99 * kDegree);
  CHECK(fine.contact_time == Approx(coarse.contact_time).epsilon(1e-3));
  CHECK(fine.end[NORMAL] == Approx(coarse.end[NORMAL]).epsilon(1e-3));
  CHECK(fine.end[FRICTION_X] == Approx(coarse.end[FRICTION_X]).epsilon(3e-3));
}

TEST_CASE("a tip that crosses the pole continues on the other side and leaves") {
  Parameters p = stiff_paper_point();
  p.pole_rule = PoleRule::cross;
  const double speed = 0.1;
  OdeState y{};
  y[X] = 1e-4, y[VX] = -speed, y[VY] = 1e-3, y[THETA] = 0.3;
  OdeState crossed = y;
  REQUIRE(apply_pole_rule(p, crossed));
  CHECK(crossed[X] == -y[X]);
  CHECK(crossed[VX] == y[VX]);
  CHECK(crossed[VY] == y[VY]);
  CHECK(crossed[THETA] == Approx(0.3 + M_PI));
  CHECK_FALSE(apply_pole_rule(p, crossed));  // the tip now moves away from the pole
  const Passage r = pass(p, 0.62, 180 * kDegree);
  CHECK(r.outcome == Outcome::left);
  CHECK(r.reflections > 0);
}

TEST_CASE("the initial states: tip at the gap, at rest, and with minimum energy for at_slab") {
  Parameters p = with_peak();
  const double z_0 = 0.6;
  const Equilibrium under = InitialStates(p).at(z_0);
  CHECK(under.r * std::sin(under.phi) < z_0);
  p.initial_state = InitialState::upright;
  const Equilibrium upright = InitialStates(p).at(z_0);
  CHECK(upright.phi == p.phi_0);
  CHECK(upright.r * std::sin(upright.phi) == Approx(z_0));
  p.initial_state = InitialState::unstretched;
  const Equilibrium unstretched = InitialStates(p).at(z_0);
  CHECK(unstretched.r == 1);
  CHECK(std::sin(unstretched.phi) == Approx(z_0 - 5 * p.lambda_z));
  CHECK(InitialStates(p).at(1.2).phi == p.phi_0);
  p.initial_state = InitialState::at_slab;
  const Equilibrium bent = InitialStates(p).at(z_0);
  CHECK(bent.r * std::sin(bent.phi) == Approx(z_0));
  const auto b = make_bristle(p, z_0, 0);
  const auto U = [&](double phi) {
    const double r = z_0 / std::sin(phi);
    return potential_energy(b, {r * std::cos(phi), 0, z_0}, 0.0, phi);
  };
  for (double phi = 0.05; phi < p.phi_0; phi += 0.01) CHECK(U(bent.phi) <= U(phi) + 1e-9);
}

TEST_CASE("the limit of evaluations, including rejected steps, ends a passage with outcome step_limit") {
  IntegratorOptions options;
  options.max_evaluations = 1000;
  const Passage r = pass(with_peak(), 0.4, 1, options);
  CHECK(r.outcome == Outcome::step_limit);
  CHECK(r.evaluations <= 1001);
  CHECK(!r.complete());
}

TEST_CASE("a passage that cannot be computed has outcome not_finite") {
  Parameters p = with_peak();
  auto b = make_bristle(p, 0.4, 1);
  const Equilibrium e = static_equilibrium(b);
  b.k_r = std::numeric_limits<double>::quiet_NaN();
  CHECK(run_passage({&p, b, e, {}}).outcome == Outcome::not_finite);
}

TEST_CASE("the observer is called at every step from the start to the exit") {
  const Parameters p = with_peak();
  const auto b = make_bristle(p, 0.4, 1);
  std::vector<double> times;
  const Passage r = run_passage({&p, b, static_equilibrium(b), {}},
                                [&](double xi, const OdeState&) { times.push_back(xi); });
  REQUIRE(times.size() == std::size_t(r.steps) + 1);
  CHECK(times.front() == 0);
  CHECK(times.back() == r.contact_time);
  CHECK(std::is_sorted(times.begin(), times.end()));
}

}  // namespace bristle::passage_test
