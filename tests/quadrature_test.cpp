#include "generators.hpp"
#include "interface/quadrature.hpp"

#include <catch2/catch.hpp>

using namespace bristle;
using namespace bristle::testing;

namespace {

using Result = QuadratureResult<1>;

Result integrate(const std::function<double(double)>& f, const std::function<int(double)>& label,
                 double rtol) {
  QuadratureOptions<1> options;
  options.rtol[0] = rtol;
  options.edges = {0, 2.6, M_PI};
  const Quadrature<1>::Function sampled = [&](double x) { return Sample<1>{{f(x)}, label(x), true}; };
  return Quadrature<1>(sampled, options).integrate();
}

int no_label(double) { return 0; }

}  // namespace

TEST_CASE("Kronrod rules: exact for polynomials, Gauss inside") {
  for (const double width : {1.0, 0.1}) {
    const KronrodRule& rule = kronrod_rule(width);
    const int n = int(rule.node.size());
    const auto moment = [&](const std::vector<double>& weight, int power) {
      double sum = 0;
      for (int i = 0; i < n; ++i) sum += weight[i] * std::pow(rule.node[i], power);
      return sum;
    };
    for (int power = 0; power <= n - 2; power += 2) {
      CHECK(moment(rule.weight, power) == Approx(2.0 / (power + 1)).epsilon(1e-13));
      CHECK(moment(rule.gauss_weight, power) == Approx(2.0 / (power + 1)).epsilon(1e-13));
    }
  }
}

TEST_CASE("smooth integrands: the error is within its estimate, the estimate within the tolerance") {
  rc::prop("for random trigonometric sums", [] {
    const double a = uniform(-1, 1), w = uniform(0.5, 12), phase = uniform(0, 6);
    const double rtol = log_uniform(1e-8, 1e-2);
    const auto r = integrate([=](double x) { return 2 + a * std::sin(w * x + phase); }, no_label, rtol);
    const double exact = 2 * M_PI + a * (std::cos(phase) - std::cos(w * M_PI + phase)) / w;
    RC_ASSERT(r.status == QuadratureStatus::converged);
    RC_ASSERT(std::abs(r.integral[0] - exact) <= r.error[0] + 1e-13);
    RC_ASSERT(r.error[0] <= rtol * r.integral[0]);
  });
}

TEST_CASE("jumps: located from the labels, the error within its estimate") {
  rc::prop("for a jump anywhere, of any height", [] {
    const double at = uniform(0.001, M_PI - 0.001), height = log_uniform(0.1, 1000);
    const double rtol = log_uniform(1e-6, 1e-2);
    const auto f = [=](double x) { return 1 + 0.3 * std::cos(x) + (x > at ? height : 0); };
    const auto r = integrate(
        f, [=](double x) { return x > at ? 1 : 0; }, rtol);
    const double exact = M_PI + height * (M_PI - at);
    RC_ASSERT(r.status == QuadratureStatus::converged);
    RC_ASSERT(std::abs(r.integral[0] - exact) <= r.error[0] + 1e-12 * exact);
    RC_ASSERT(r.samples < 400);
  });
}

TEST_CASE("jumps between two panels and beside the ends are found") {
  for (const double at : {2.6, 2.5999, 2.6001, 1e-4, M_PI - 1e-4}) {
    CAPTURE(at);
    const auto r = integrate([=](double x) { return x > at ? 2000.0 : 1.0; },
                             [=](double x) { return x > at ? 1 : 0; }, 1e-4);
    const double exact = at + 2000 * (M_PI - at);
    CHECK(std::abs(r.integral[0] - exact) <= r.error[0]);
    CHECK(r.error[0] <= 1e-4 * exact);
    REQUIRE(!r.jumps.empty());
    CHECK(r.jumps.front() == Approx(at).margin(1e-3));
  }
}

TEST_CASE("several jumps, and rough stretches: the estimate stays honest") {
  // A rough stretch as the bouncing bristles make it: a sum of incommensurate fast oscillations.
  int honest = 0, cases = 0;
  for (int seed = 0; seed < 40; ++seed) {
    const double w = 150 + 17.3 * seed, from = 0.8 + 0.01 * seed, to = 1.9;
    const auto f = [=](double x) {
      return 2 + (x > from && x < to ? 0.2 * std::sin(w * x) + 0.1 * std::cos(2.71 * w * x) : 0.0);
    };
    const auto F = [=](double x) {
      return -0.2 * std::cos(w * x) / w + 0.1 * std::sin(2.71 * w * x) / (2.71 * w);
    };
    const double exact = 2 * M_PI + F(to) - F(from);
    const auto r = integrate(f, no_label, 1e-3);
    ++cases;
    if (std::abs(r.integral[0] - exact) <= r.error[0]) ++honest;
  }
  // The estimate is a standard deviation of independent panel errors, not a bound: nearly all lie within.
  CHECK(honest >= cases * 0.9);
}

TEST_CASE("a jump that was narrowed enough and later is the worst part is narrowed on, not passed again") {
  // Beside a stretch so rough that its panels' errors sink below what the jump's place had been left with.
  for (const double height : {20.0, 40.0, 80.0}) {
    CAPTURE(height);
    const auto f = [=](double x) {
      return 1 + (x > 0.7 && x < 2.9 ? 0.3 * std::sin(300 * x) + 0.2 * std::cos(811 * x) : 0.0) +
             (x > 3.1 ? height : 0);
    };
    const auto r = integrate(
        f, [](double x) { return x > 3.1 ? 1 : 0; }, 1e-3);
    CHECK(r.status == QuadratureStatus::converged);
    CHECK(r.samples < 8000);
  }
}

TEST_CASE("an estimate that cannot reach the tolerance is reported, and so is an invalid sample") {
  QuadratureOptions<1> options;
  options.rtol[0] = 1e-12;
  options.edges = {0, 1};
  options.max_samples = 100;
  const Quadrature<1>::Function rough = [](double x) { return Sample<1>{{1 + std::sin(1e4 * x)}, 0, true}; };
  CHECK(Quadrature<1>(rough, options).integrate().status == QuadratureStatus::not_converged);
  const Quadrature<1>::Function broken = [](double x) { return Sample<1>{{1}, 0, x < 0.5}; };
  const auto r = Quadrature<1>(broken, options).integrate();
  CHECK(r.status == QuadratureStatus::invalid);
  CHECK(r.samples < 40);
}

TEST_CASE("a decision needs fewer samples than a value") {
  const auto f = [](double x) { return 1 + std::pow(std::abs(x - 1.3), 0.3); };
  QuadratureOptions<1> options;
  options.rtol[0] = 1e-7;
  options.edges = {0, M_PI};
  const Quadrature<1>::Function sampled = [&](double x) { return Sample<1>{{f(x)}, 0, true}; };
  const auto value = Quadrature<1>(sampled, options).integrate();
  options.decide_about = 2.0;
  const auto decision = Quadrature<1>(sampled, options).integrate();
  CHECK(decision.samples < value.samples / 3);
  CHECK(decision.error[0] <= std::abs(decision.integral[0] - 2) / 4);
}
