#include "bristle/ensemble/nested_rule.hpp"
#include "bristle/ensemble/quadrature.hpp"
#include "generators.hpp"

#include <algorithm>
#include <array>
#include <random>
#include <stdexcept>
#include "catch.hpp"

namespace bristle::quadrature_test {
using namespace testing;

namespace {

using Result = QuadratureResult;

Quadrature::Function batched(const std::function<Sample(double)>& f) {
  return [f](const std::vector<double>& at) {
    std::vector<Sample> out;
    for (double x : at) out.push_back(f(x));
    return out;
  };
}

Result integrate(const std::function<double(double)>& f, const std::function<int(double)>& label,
                 double rtol) {
  QuadratureGoal goal;
  goal.rtol[0] = rtol;
  goal.too_wide = [](double left, double right) { return right - left > 0.35; };
  return Quadrature(batched([&](double x) {
                      return Sample{{f(x)}, label(x), false, true};
                    }),
                    {0, 2.6, M_PI})
      .refine(goal);
}

int no_label(double) { return 0; }

}  // namespace

TEST_CASE("nested rules and their interpolation from every second node are exact for polynomials") {
  for (const std::size_t n : {2, 3, 5, 9}) {
    const NestedRule& rule = nested_rule(n);
    REQUIRE(rule.weight.size() == n);
    for (std::size_t power = 0; power <= std::min<std::size_t>(n - 1, 7); ++power) {
      double sum = 0;
      const auto at = [&](std::size_t i) { return std::pow(double(i) / double(n - 1), double(power)); };
      for (std::size_t i = 0; i < n; ++i) sum += rule.weight[i] * at(i);
      CHECK(sum == Approx(1.0 / double(power + 1)).epsilon(1e-13));
      if (power > n / 2) continue;
      for (std::size_t i = 0; i < rule.between.size(); ++i) {
        double value = 0;
        for (std::size_t j = 0; j < rule.between[i].size(); ++j) value += rule.between[i][j] * at(2 * j);
        CHECK(value == Approx(at(2 * i + 1)).margin(1e-13));
      }
    }
  }
}

TEST_CASE("a change of outcome counts by the spread of the values in its panel") {
  // The nodes on both sides of the change, at 0.25 and 0.5, have the same value.
  const auto f = [](double x) { return Sample{{x > 0.6 ? 1.0 : 0.0}, x > 0.3 ? 1 : 0, false, true}; };
  QuadratureGoal anything;
  anything.rtol[0] = 100;
  const auto r = Quadrature(batched(f), {0, 1}).refine(anything);
  CHECK(r.samples == 5);
  CHECK(r.error[0] >= 0.125);  // half of the gap between these nodes
}

TEST_CASE("panels that are too wide are divided whatever the errors are") {
  const auto f = [](double) { return Sample{{1.0}, 0, false, true}; };
  QuadratureGoal goal;
  goal.rtol[0] = 1;
  // Nodes near 1 must be closer than elsewhere.
  goal.too_wide = [](double left, double right) { return right - left > std::max(0.02, 1 - right); };
  std::vector<double> asked;
  Quadrature quadrature(
      [&](const std::vector<double>& at) {
        asked.insert(asked.end(), at.begin(), at.end());
        return batched(f)(at);
      },
      {0, 1});
  quadrature.refine(goal);
  std::sort(asked.begin(), asked.end());
  CHECK(asked[asked.size() - 1] - asked[asked.size() - 2] <= 0.02 / 4);
  CHECK(asked[1] - asked[0] > 0.02);
}

TEST_CASE("a second goal reuses the existing samples") {
  std::vector<double> asked;
  const auto f = [&](double x) {
    asked.push_back(x);
    return Sample{{std::exp(x) + (x > 2 ? 5 : 0)}, x > 2 ? 1 : 0, false, true};
  };
  Quadrature quadrature(batched(f), {0, 2.6, M_PI});
  QuadratureGoal rough, fine;
  rough.rtol[0] = 1e-2;
  fine.rtol[0] = 1e-6;
  const long few = quadrature.refine(rough).samples;
  const auto r = quadrature.refine(fine);
  CHECK(r.samples > few);
  CHECK(std::size_t(r.samples) == asked.size());
  std::sort(asked.begin(), asked.end());
  CHECK(std::adjacent_find(asked.begin(), asked.end()) == asked.end());  // no sample is computed twice
  const double exact = std::exp(M_PI) - 1 + 5 * (M_PI - 2);
  CHECK(std::abs(r.integral[0] - exact) <= r.error[0]);
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

TEST_CASE("jumps are located by the labels, and the error is within its estimate") {
  rc::prop("for a jump anywhere, of any height", [] {
    const double at = uniform(0.001, M_PI - 0.001), height = log_uniform(0.1, 1000);
    const double rtol = log_uniform(1e-6, 1e-2);
    const auto f = [=](double x) { return 1 + 0.3 * std::cos(x) + (x > at ? height : 0); };
    const auto r = integrate(
        f, [=](double x) { return x > at ? 1 : 0; }, rtol);
    const double exact = M_PI + height * (M_PI - at);
    RC_ASSERT(r.status == QuadratureStatus::converged);
    // The estimate is the root of the sum of squares of the jump's error and that of the panels. If both have
    // the same sign, their sum is up to sqrt(2) times as large.
    RC_ASSERT(std::abs(r.integral[0] - exact) <= std::sqrt(2) * r.error[0] + 1e-12 * exact);
    RC_ASSERT(r.samples < 600);
  });
}

TEST_CASE("jumps between two panels and next to the ends are found") {
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

TEST_CASE(
    "rough ranges: the error is within its estimate in about half of the cases, and rarely beyond three "
    "times it") {
  // A rough range like that of bouncing bristles: fast oscillations of varying frequency. (Equidistant nodes
  // may not resolve an oscillation of a single frequency at all.)
  int within_one = 0, within_three = 0, cases = 0;
  for (int seed = 0; seed < 40; ++seed) {
    const double w = 150 + 17.3 * seed, from = 0.8 + 0.01 * seed, to = 1.9;
    const auto f = [=](double x) {
      return 2 +
             (x > from && x < to ? 0.2 * std::sin(w * x * x) + 0.1 * std::cos(2.71 * w * std::exp(x)) : 0.0);
    };
    double exact = 2 * M_PI;
    const int steps = 200000;
    const double step = (to - from) / steps;
    for (int i = 0; i < steps; ++i) exact += (f(from + (i + 0.5) * step) - 2) * step;
    const auto r = integrate(f, no_label, 1e-3);
    ++cases;
    if (std::abs(r.integral[0] - exact) <= r.error[0]) ++within_one;
    if (std::abs(r.integral[0] - exact) <= 3 * r.error[0]) ++within_three;
  }
  // The estimate adds independent panel errors and is not a bound, and panels that appear smooth by chance
  // are not refined: of 400 such functions, 49 % are within the estimate and 94.5 % within three times it.
  CHECK(within_one >= cases * 0.4);
  CHECK(within_three >= cases * 0.9);
}

namespace {

// Labels that change at every scale above `from`, in a set with a share of some ten per cent: where
// Weierstrass's function with random phases is large.
struct AlternatingLabels {
  double from;
  std::array<double, 14> phases{};

  AlternatingLabels(double from_, unsigned seed) : from(from_) {
    for (double& phase : phases) phase = 2 * M_PI * double(std::mt19937(seed++)()) / 4294967296.0;
  }
  int operator()(double x) const {
    double sum = 0, frequency = 20, size = 1;
    for (const double phase : phases) {
      sum += size * std::cos(frequency * x + phase);
      frequency *= 2.3;
      size *= 0.8;
    }
    return x > from && sum > 0.8 ? 1 : 0;
  }
};

}  // namespace

TEST_CASE("where labels alternate at every scale, the error is the statistical one of equidistant nodes") {
  int beyond_two = 0, beyond_three = 0;
  for (const double rtol : {1e-2, 3e-3, 1e-3}) {
    const int cases = 40;
    for (int seed = 0; seed < cases; ++seed) {
      const AlternatingLabels label(2.9, 100 * seed);
      const auto f = [&](double x) { return 1 + 0.3 * std::cos(x) + (label(x) == 1 ? 8 : 0); };
      QuadratureGoal goal;
      goal.rtol[0] = rtol;
      goal.too_wide = [](double left, double right) {  // as for bristles that point against the motion
        return right - left > std::clamp(M_PI - right, 0.01, 0.175) + 1e-9;
      };
      const auto sample = batched([&](double x) { return Sample{{f(x)}, label(x), x > 2.87, true}; });
      const auto r = Quadrature(sample, {0, 2.6, M_PI}).refine(goal);
      double exact = M_PI;
      const int steps = 100000;
      const double step = (M_PI - label.from) / steps;
      for (int i = 0; i < steps; ++i) exact += label(label.from + (i + 0.5) * step) == 1 ? 8 * step : 0;
      const double distance = std::abs(r.integral[0] - exact) / r.error[0];
      CAPTURE(rtol, seed, exact, r.integral[0], r.error[0], r.samples);
      beyond_three += distance > 3;
      CHECK(distance <= 4);
      CHECK((r.status == QuadratureStatus::converged) == (r.error[0] <= rtol * r.integral[0]));
      beyond_two += distance > 2;
    }
  }
  // As of independent values: 5 % are beyond two errors, and 1 of 120 is beyond three. With jumps in place of
  // these panels 79 were beyond three.
  CHECK(beyond_two <= 7);
  CHECK(beyond_three <= 1);
}

TEST_CASE(
    "a range of alternating labels is not divided by a later goal, and has as many nodes as that allows") {
  const AlternatingLabels label(2.9, 300);
  Quadrature quadrature(batched([&](double x) {
                          return Sample{{1.0 + 8 * label(x)}, label(x), x > 2.87, true};
                        }),
                        {0, 2.6, M_PI});
  QuadratureGoal first, second;
  first.rtol[0] = 1e-5;
  first.most_alternating = 128;
  const QuadratureResult few = quadrature.refine(first);
  CHECK(few.status == QuadratureStatus::not_converged);
  CHECK(few.samples < 400);
  second.rtol[0] = 1e-5;
  second.too_wide = [](double left, double right) { return right - left > 0.1; };
  const QuadratureResult many = quadrature.refine(second);
  CHECK(many.status == QuadratureStatus::not_converged);
  CHECK(many.samples < 4096);
  CHECK(many.error[0] < few.error[0] / 2);
}

TEST_CASE("a quadrature that its function ends keeps what it has") {
  long left = 150;
  const auto f = [&](const std::vector<double>& at) {
    if (left < long(at.size())) throw std::runtime_error("enough");
    left -= long(at.size());
    return batched([](double x) { return Sample{{std::exp(std::sin(40 * x))}, 0, false, true}; })(at);
  };
  Quadrature quadrature(f, {0, 2.6, M_PI});
  QuadratureGoal goal;
  goal.rtol[0] = 1e-9;
  CHECK_THROWS(quadrature.refine(goal));
  const auto& r = quadrature.interrupted();
  CHECK(r.status == QuadratureStatus::not_converged);
  CHECK(r.samples <= 150);
  CHECK(r.error[0] > 0);
  CHECK(std::abs(r.integral[0] - 3.97746) < 3 * r.error[0]);
}

TEST_CASE("a jump that becomes the largest error later is narrowed further") {
  // Next to a range so rough that the errors of its panels fall below the error of the jump only later.
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

TEST_CASE("a tolerance that cannot be reached and an invalid sample are reported") {
  QuadratureGoal goal;
  goal.rtol[0] = 1e-12;
  const auto rough = batched([](double x) { return Sample{{1 + std::sin(1e4 * x)}, 0, false, true}; });
  CHECK(Quadrature(rough, {0, 1}, 100).refine(goal).status == QuadratureStatus::not_converged);
  const auto broken = batched([](double x) { return Sample{{1}, 0, false, x < 0.5}; });
  const auto r = Quadrature(broken, {0, 1}, 100).refine(goal);
  CHECK(r.status == QuadratureStatus::invalid);
  CHECK(r.samples < 40);
}

TEST_CASE("comparing with a threshold needs fewer samples than a precise value") {
  const auto f = batched([](double x) {
    return Sample{{1 + std::pow(std::abs(x - 1.3), 0.3)}, 0, false, true};
  });
  QuadratureGoal goal;
  goal.rtol[0] = 1e-6;
  const auto value = Quadrature(f, {0, M_PI}).refine(goal);
  goal.threshold = 2.0;
  const auto decision = Quadrature(f, {0, M_PI}).refine(goal);
  CHECK(decision.samples < value.samples / 3);
  CHECK(decision.error[0] <= std::abs(decision.integral[0] - 2) / 4);
}

}  // namespace bristle::quadrature_test
