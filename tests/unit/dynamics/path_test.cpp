#include "bristle/ensemble/observables.hpp"
#include "generators.hpp"
#include "bristle/model/equilibrium.hpp"
#include "bristle/simd/runner.hpp"

#include "catch.hpp"

namespace bristle::path_test {
using namespace testing;
using namespace component;

namespace {

// A passage of the random bristle by both engines: the fast one's, then the reference engine's.
std::array<Passage, 2> passages(const Parameters& p, double z_0, double theta_0, double rtol) {
  const auto b = make_bristle(p, z_0, theta_0);
  const PassageTask task{&p, b, static_equilibrium(b), {rtol, rtol / 100, Method::automatic, 20'000'000}};
  static const PassageRunner fast = make_runner(Engine::fast);
  return {fast({task}).front(), run_passage(task)};
}

std::array<Passage, 2> random_passages(const Parameters& p, double rtol) {
  return passages(p, uniform(0.1, 0.95), uniform(-3.0, 3.0), rtol);
}

double value(const char* name, const Passage& passage, const Parameters& p) {
  for (const ObservableRow& row : kObservables)
    if (row.name == std::string_view(name)) return row.value(passage, p);
  throw std::runtime_error(name);
}

}  // namespace

TEST_CASE("path quantities agree with those of Boost.Odeint") {
  rc::prop("for random bristles", [] {
    const Parameters p = random_parameters();
    const auto [lane, reference] = random_passages(p, 1e-10);
    RC_PRE(reference.complete() && reference.reflections == 0);
    const auto close = [](double a, double b, double share) {
      return std::abs(a - b) <= share * (std::abs(b) + 1e-2);
    };
    for (const char* name : {"sliding_work", "F_n_spread", "tip_travel", "stretch_peak", "bending_peak"})
      RC_ASSERT(close(value(name, lane, p), value(name, reference, p), 1e-3));
    RC_ASSERT(close(lane.path[LOAD_PEAK], reference.path[LOAD_PEAK], 5e-3));
    // The instant at which the tip leaves the slab or begins to slide is known to about a step.
    const double instants = 2 * (reference.path[IMPACTS] + 1);
    const double share = 2 * instants * (1.0 / double(lane.steps) + 1.0 / double(reference.steps));
    for (const char* name : {"stuck_share", "off_slab_share"})
      RC_ASSERT(std::abs(value(name, lane, p) - value(name, reference, p)) <= share);
    // Between two steps a tip may graze the limit of being off the slab.
    RC_ASSERT(std::abs(lane.path[IMPACTS] - reference.path[IMPACTS]) <= 1);
  });
}

TEST_CASE("without dampers friction loses the energy that the slab gives and the bristle does not keep") {
  rc::prop("for random bristles", [] {
    Parameters p = random_parameters();
    p.zeta_theta = p.zeta_phi = 0;
    for (const Passage& one : random_passages(p, 1e-8)) {
      RC_PRE(one.complete() && one.reflections == 0);
      const double dissipated = one.end[FRICTION_X] - one.end[WORK];
      RC_ASSERT(value("sliding_work", one, p) * p.L_x == Approx(dissipated).epsilon(1e-4).margin(1e-4));
    }
  });
}

TEST_CASE("shares of time lie between 0 and 1, and peaks are at least the means") {
  rc::prop("for random bristles", [] {
    const Parameters p = random_parameters();
    for (const Passage& one : random_passages(p, 1e-5)) {
      RC_PRE(one.complete());
      const double stuck = value("stuck_share", one, p), off = value("off_slab_share", one, p);
      RC_ASSERT(stuck >= 0);
      RC_ASSERT(off >= 0);
      RC_ASSERT(stuck + off <= 1 + 1e-12);
      RC_ASSERT(one.path[LOAD_PEAK] >= one.end[NORMAL] / one.contact_time);
      RC_ASSERT(value("tip_travel", one, p) >= one.contact_time - p.L_x - 1e-9);  // the travel at the exit
      RC_ASSERT(value("bending_peak", one, p) <= M_PI);
    }
  });
}

TEST_CASE("an impact is a return to the slab") {
  Parameters p;
  const auto b = make_bristle(p, 0.9, 0);
  Path<double> path{};
  const double off = 0.9 - 1.01 * kOffSlabRanges * p.lambda_z, on = 0.9 - 0.99 * kOffSlabRanges * p.lambda_z;
  for (const double z : {on, off, off, on, on, off, on, off})
    add_position(b, Vector3<double>{0.5, 0, z}, frame_at(Vector3<double>{0.5, 0, z}, true), 0.3, path);
  CHECK(path[IMPACTS] == 2);
  CHECK(path[TRAVEL_PEAK] == Approx(0.2));
  CHECK(path[STRETCH_PEAK] == Approx(std::hypot(0.5, on) - 1));
}

TEST_CASE("a tip that begins at the slab is not off it while it leaves it into the slab") {
  Parameters p;
  p.bending = Bending::rod;
  p.contact = Contact::hertz;
  p.initial_state = InitialState::unstretched;
  p.phi_0 = 66 * M_PI / 180;
  p.k_r = 115;
  p.E_star = 11000;
  p.tau_f = 600;
  p.C = chi_C_peak_at_V_s(p.A);
  InitialStates starts(p);
  for (const Engine engine : {Engine::fast, Engine::reference})
    for (const double z_0 : {0.18, 0.18975489255313313, 0.2, 0.21}) {
      const PassageTask task{&p, make_bristle(p, z_0, 169 * M_PI / 180), starts.at(z_0), {1e-4, 1e-6}};
      CAPTURE(z_0, int(engine));
      CHECK(make_runner(engine)({task}).front().path[OFF_SLAB_TIME] == 0);
    }
}

TEST_CASE("the largest bending is the angle to the undeformed bristle") {
  for (const double angle : {0.0, 1e-6, 0.3, 1.0, 3.0}) {
    Parameters p;
    const auto b = make_bristle(p, 0.9, 0.7);
    const double phi = b.phi_0 - angle;
    const Vector3<double> tip{cos(phi) * b.cos_theta_0, cos(phi) * b.sin_theta_0, sin(phi)};
    Path<double> path{};
    add_position(b, tip, frame_at(tip, true), 0.0, path);
    CHECK(angle_of_versed(path[BENDING_PEAK]) == Approx(angle).margin(2e-8));
  }
}

TEST_CASE("the spread of a constant load is 0, that of one at half of the time 1") {
  Passage passage;
  passage.contact_time = 2;
  passage.end[NORMAL] = 6;
  passage.path[SQUARED_LOAD] = 18;
  CHECK(load_spread(passage) == 0);
  passage.path[SQUARED_LOAD] = 36;
  CHECK(load_spread(passage) == 1);
  passage.end[NORMAL] = passage.path[SQUARED_LOAD] = 0;  // as of a bristle that only grazes the slab
  CHECK(load_spread(passage) == 0);
}

TEST_CASE("the strain at the root is that of a cantilever's end load") {
  Parameters p;
  p.R = 0.1;
  CHECK(root_strain(p, 0.2) == Approx(0.06));
}

TEST_CASE("the largest pressure is that of Hertz") {
  Parameters p;
  const double F = 3.7;
  CHECK(hertz_pressure(p, F) ==
        Approx(cbrt(6 * F * p.E_star * p.E_star / (M_PI * M_PI * M_PI * p.R_c * p.R_c))));
}

}  // namespace bristle::path_test
