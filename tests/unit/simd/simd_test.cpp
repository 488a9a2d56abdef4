#include "bristle/simd/dispatch.hpp"
#include "bristle/simd/engine.hpp"
#include "bristle/simd/tableau.hpp"
#include "generators.hpp"

#include <hwy/targets.h>

#include <algorithm>
#include "catch.hpp"
#include <deque>

namespace bristle::simd_test {
using namespace testing;
using namespace component;

namespace {

// Bristles of all kinds: two friction laws, all bendings, some pinned, some reflected at the pole.
class Sample {
 public:
  PassageTask random(double largest = M_PI) {
    Parameters& p = parameters_.emplace_back(random_parameters());
    const bool head_on = largest == M_PI && *rc::gen::inRange(0, 5) == 0;
    const double theta_0 = head_on ? M_PI - log_uniform(1e-4, 0.1) : uniform(-largest, largest);
    return task(p, uniform(0.1, 0.95), theta_0);
  }
  PassageTask head_on(double degrees) {
    Parameters& p = parameters_.emplace_back();
    p.k_r = 50;
    p.C = chi_C_peak_at_V_s(p.A);
    return task(p, 0.62, degrees * M_PI / 180);
  }
  static PassageTask task(const Parameters& p, double z_0, double theta_0) {
    const auto b = make_bristle(p, z_0, theta_0);
    return {&p, b, static_equilibrium(b), {1e-5, 1e-7, Method::automatic, 2'000'000}};
  }

 private:
  std::deque<Parameters> parameters_;  // a deque, because tasks point to its elements
};

std::vector<Passage> run(const Kernels& kernels, const std::vector<PassageTask>& tasks) {
  std::vector<Passage> out(tasks.size());
  SimdEngine engine(kernels, [&](std::size_t ticket, Passage&& p) { out[ticket] = std::move(p); });
  for (std::size_t i = 0; i < tasks.size(); ++i) engine.submit(tasks[i], i);
  while (engine.advance()) {
  }
  return out;
}

bool same_bits(const Passage& a, const Passage& b) {
  return a.end == b.end && a.path == b.path && a.contact_time == b.contact_time && a.outcome == b.outcome &&
         a.steps == b.steps && a.reflections == b.reflections && a.gamma_1 == b.gamma_1 &&
         a.gamma_2 == b.gamma_2 && a.gamma_3 == b.gamma_3 && a.energy_residual == b.energy_residual;
}

struct Restricted {
  explicit Restricted(std::int64_t targets) { hwy::SetSupportedTargetsForTest(targets); }
  ~Restricted() { hwy::SetSupportedTargetsForTest(0); }
};

}  // namespace

TEST_CASE("a passage has the same bits alone, in batches of any order, and with every instruction set") {
  rc::prop("for random batches", [] {
    Sample sample;
    std::vector<PassageTask> tasks;
    const int count = *rc::gen::inRange(1, 40);
    for (int i = 0; i < count; ++i) tasks.push_back(sample.random());
    tasks.push_back(sample.head_on(179.99));
    const auto together = run(best_kernels(), tasks);
    const std::size_t probe = std::size_t(*rc::gen::inRange(0, count));
    RC_ASSERT(same_bits(run(best_kernels(), {tasks[probe]}).front(), together[probe]));
    std::vector<PassageTask> reversed(tasks.rbegin(), tasks.rend());
    auto backwards = run(best_kernels(), reversed);
    std::reverse(backwards.begin(), backwards.end());
    for (const Kernels* kernels : available_kernels()) {
      const auto here = run(*kernels, tasks);
      for (std::size_t i = 0; i < tasks.size(); ++i) RC_ASSERT(same_bits(here[i], together[i]));
    }
    for (std::size_t i = 0; i < tasks.size(); ++i) RC_ASSERT(same_bits(backwards[i], together[i]));
  });
}

TEST_CASE("bristles of different threshold speeds share lanes") {
  std::deque<Parameters> parameters;
  std::size_t ended = 0;
  SimdEngine engine(best_kernels(), [&](std::size_t, Passage&& p) { ended += p.complete() ? 1 : 0; });
  constexpr std::size_t count = 4 * kLanes;
  for (std::size_t i = 0; i < count; ++i) {
    Parameters& p = parameters.emplace_back();
    p.bending = Bending::rod;
    p.C = chi_C_peak_at_V_s(p.A);
    p.V_s = 0.005 + 0.001 * double(i);
    engine.submit(Sample::task(p, 0.6, 1), i);
  }
  while (engine.advance()) {
  }
  CHECK(ended == count);
  // With lanes for each speed alone it would be 1/8 or less.
  CHECK(engine.usage().passage_steps > 0.5 * engine.usage().lane_steps);
}

TEST_CASE("without vectors with fused multiply-add the fast engine computes one number at a time") {
  const Restricted old_processor(HWY_SCALAR);
  CHECK(available_kernels().size() == 1);
  CHECK(std::string(best_kernels().target) == "SCALAR");
  CHECK(best_kernels().width == 1);
}

TEST_CASE("restricting the instruction sets restricts the kernels") {
#if HWY_ARCH_X86
  const bool has = available_kernels().size() > 1;
  const Restricted avx2(HWY_AVX2);
  if (has) {
    REQUIRE(available_kernels().size() == 2);
    CHECK(std::string(best_kernels().target) == "AVX2");
  }
#endif
}

TEST_CASE("all observables agree with those of Boost.Odeint within the integrators' errors") {
  // The tolerances are tight, so that impacts do not amplify the step errors beyond the asserted limits: at
  // 1e-8 one passage in some thousands differs by more than 1e-4, in proportion to the tolerance.
  // Reflections at the pole would do so at any tolerance; they have a separate test.
  rc::prop("for random bristles", [] {
    Sample sample;
    PassageTask task = sample.random(3.0);
    task.integrator.rtol = 1e-10;
    task.integrator.atol = 1e-12;
    const Passage lane = run(best_kernels(), {task}).front(), reference = run_passage(task);
    RC_PRE(reference.reflections == 0 && reference.complete());
    RC_ASSERT(lane.outcome == reference.outcome);
    const auto close = [](double a, double b, double scale) {
      return std::abs(a - b) <= 1e-4 * (std::abs(scale) + 1e-3);
    };
    RC_ASSERT(close(lane.contact_time, reference.contact_time, reference.contact_time));
    for (const int i : {NORMAL, FRICTION_X, MODULATION, ALIGNMENT, AREA, WORK})
      RC_ASSERT(close(lane.end[i], reference.end[i], reference.end[NORMAL] + std::abs(reference.end[i])));
    RC_ASSERT(close(lane.end[FRICTION_Y], reference.end[FRICTION_Y], reference.end[FRICTION_X]));
    RC_ASSERT(close(lane.gamma_1, reference.gamma_1, 1));
    RC_ASSERT(close(lane.gamma_2, reference.gamma_2, 1));
    RC_ASSERT(close(lane.gamma_3, reference.gamma_3, 1));
  });
}

TEST_CASE("pinned bristles have the values of an independent prototype, with and without reflections") {
  for (const double degrees : {179.5, 179.8, 179.99}) {
    Parameters p;
    p.k_r = 50;
    p.phi_0 = 81 * M_PI / 180;
    p.C = 0;
    PassageTask task = Sample::task(p, 0.62, degrees * M_PI / 180);
    task.integrator.rtol = 1e-6;
    task.integrator.atol = 1e-8;
    const Passage r = run(best_kernels(), {task}).front();
    // A hundred reflections amplify errors: the values of Odeint have the same spread over tolerances of 1e-5
    // to 1e-8.
    const double spread = degrees > 179.7 ? 10 : 1;
    CAPTURE(degrees);
    CHECK(r.outcome == Outcome::pinned);
    CHECK(r.implicit);
    CHECK((r.reflections > 0) == (degrees > 179.7));
    CHECK(r.contact_time == Approx(5.758).margin(1e-3 * spread));
    CHECK(r.end[NORMAL] / 5 == Approx(20.77).margin(5e-3 * spread));
    CHECK(r.end[FRICTION_X] / 5 == Approx(57.0).margin(0.05 + 0.01 * spread));
    CHECK(r.energy_residual < 1e-3);
  }
}

TEST_CASE("the lanes near the pole stop where a step may reach s_min, and not where it turns beside it") {
  Parameters p;
  p.zeta_theta = p.zeta_phi = 0;  // without forces that grow towards the pole, which would bend the path
  const PassageTask task = Sample::task(p, 0.62, M_PI);
  const double s_min = p.s_min, h = 1e-6;
  const ModulationTable modulation(task.bristle.friction, task.bristle.friction_constants);
  for (const double closest : {0.5, 0.9, 1.1, 3.0, 30.0}) {  // in s_min
    Block block{};
    block.friction = task.bristle.friction;
    block.bending = task.bristle.bending;
    block.modulation = &modulation;
    int i = 0;
    for (const double* constant : constants_of(task.bristle)) block.constants[i++].lane[0] = *constant;
    block.rtol.lane[0] = block.atol.lane[0] = 1;
    block.L_x.lane[0] = p.L_x;
    block.s_handover.lane[0] = 1;
    block.s_min.lane[0] = s_min;
    block.next_sample.lane[0] = INFINITY;
    block.max_attempts.lane[0] = block.last_error.lane[0] = 1;
    block.occupied = 1;
    block.h.lane[0] = h;
    // The tip moves straight past the pole, from one side to the other in this step.
    OdeState y = pack(state_at_rest(task.bristle, task.start));
    y[X] = -2 * s_min;
    y[Y] = closest * s_min;
    y[VX] = 4 * s_min / h;
    for (int c = 0; c < COMPONENTS; ++c) block.y[c].lane[0] = y[c];
    const Events events = best_kernels().near_steps(block);
    CAPTURE(closest);
    CHECK(events.pole == (closest < 1 ? 1 : 0));
    CHECK(events.exhausted == 1);
  }
}

TEST_CASE("a tip that is pushed to the base, where its dampers are stiff, takes a bounded number of steps") {
  Parameters p;
  p.k_phi = 3.8;
  p.C = chi_C_peak_at_V_s(p.A);
  PassageTask task = Sample::task(p, 0.01, M_PI);
  task.integrator = {1e-5, 2e-5, Method::automatic, 400'000};
  CHECK(run(best_kernels(), {task}).front().outcome == Outcome::pinned);
}

TEST_CASE("errors of the fast engine are proportional to the tolerance, as those of a pair of order four") {
  // Sticking and slipping are smooth here. A pair of order two would gain the root of the tolerance's factor.
  for (const FrictionLaw law : {FrictionLaw::nss, FrictionLaw::coulomb}) {
    Parameters p;
    p.friction = law;
    p.V_s = 0.5;
    p.lambda_z = 0.05;
    p.C = chi_C_peak_at_V_s(p.A);
    PassageTask task = Sample::task(p, 0.6, 1);
    const auto at = [&](double rtol) {
      task.integrator = {rtol, rtol, Method::automatic, 10'000'000};
      return run(best_kernels(), {task}).front().end[FRICTION_X];
    };
    const double exact = at(1e-13), loose = std::abs(at(1e-5) - exact), tight = std::abs(at(1e-9) - exact);
    CAPTURE(loose, tight);
    CHECK(tight < loose / 1000);
  }
}

TEST_CASE("a head-on bristle stays in its plane, at any tolerance") {
  // Its motion there is unstable, so that large rounding errors would grow to a motion out of the plane.
  Parameters p;
  p.k_r = 50;
  p.phi_0 = 81 * M_PI / 180;
  p.C = 0;
  PassageTask task = Sample::task(p, 0.62, M_PI);
  for (const double tolerance : {1e-5, 1e-7}) {
    task.integrator.rtol = tolerance;
    task.integrator.atol = tolerance / 100;
    const Passage r = run(best_kernels(), {task}).front();
    CHECK(std::abs(r.end[Y]) < 1e-8);
    CHECK(r.reflections == 117);
    CHECK(r.contact_time == Approx(5.74756).margin(1e-4 + 50 * tolerance));
    CHECK(r.energy_residual < 1e-4);
  }
}

TEST_CASE("a failure in one lane gives an outcome and does not affect the others") {
  Sample sample;
  std::vector<PassageTask> tasks = {sample.head_on(30), sample.head_on(60), sample.head_on(90)};
  const auto alone = run(best_kernels(), {tasks[0]}).front();
  tasks[1].bristle.k_r = std::numeric_limits<double>::quiet_NaN();
  tasks[2].integrator.max_evaluations = 600;
  const auto r = run(best_kernels(), tasks);
  CHECK(same_bits(r[0], alone));
  CHECK(r[1].outcome == Outcome::not_finite);
  CHECK(r[2].outcome == Outcome::step_limit);
  CHECK(r[2].evaluations <= 612);
}

TEST_CASE("a passage of the SIMD engine ends when the slip is L_x within 1e-10") {
  rc::prop("for any bristle", [] {
    Sample sample;
    const PassageTask task = sample.random();
    const Passage r = run(best_kernels(), {task}).front();
    const double x_0 = state_at_rest(task.bristle, task.start).r[0];
    RC_ASSERT(r.complete());
    RC_ASSERT(std::abs(r.contact_time - (r.end[X] - x_0) - task.parameters->L_x) <= 1e-10);
  });
}

TEST_CASE("tableaus satisfy the order conditions up to three, and the error weights sum to zero") {
  const auto check = [](const auto& a, const auto& b, const auto& error, int stages) {
    double sum = 0, first = 0, second = 0, third = 0, errors = 0;
    std::vector<double> c(std::size_t(stages), 0.0);
    for (int i = 0; i < stages; ++i)
      for (int j = 0; j < i; ++j) c[std::size_t(i)] += a[i][j];
    for (int i = 0; i < stages; ++i) {
      sum += b[i];
      first += b[i] * c[std::size_t(i)];
      second += b[i] * c[std::size_t(i)] * c[std::size_t(i)];
      for (int j = 0; j < i; ++j) third += b[i] * a[i][j] * c[std::size_t(j)];
    }
    for (const double e : error) errors += e;
    CHECK(sum == Approx(1).epsilon(1e-14));
    CHECK(first == Approx(1. / 2).epsilon(1e-14));
    CHECK(second == Approx(1. / 3).epsilon(1e-14));
    CHECK(third == Approx(1. / 6).epsilon(1e-14));
    CHECK(errors == Approx(0).margin(1e-14));
  };
  using KC = KennedyCarpenter4;
  check(KC::a, KC::b, KC::error, KC::stages);
  for (int i = 1; i < KC::stages; ++i) {  // implicit and explicit stages are at equal times
    double implicit = KC::gamma, explicit_part = 0;
    for (int j = 0; j < i; ++j) {
      implicit += KC::a_implicit[i][j];
      explicit_part += KC::a[i][j];
    }
    CHECK(implicit == Approx(explicit_part).epsilon(1e-14));
  }
}

}  // namespace bristle::simd_test
