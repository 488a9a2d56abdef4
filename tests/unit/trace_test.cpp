// The traced curve R_n(z_0): resolution, folds, landings, and the loading and unloading paths.
#include "bristle/ensemble/trace.hpp"

#include "bristle/model/friction/laws.hpp"

#include <algorithm>
#include "catch.hpp"
#include <cmath>

namespace bristle::trace_test {

namespace {

const Setup& folded_setup() {  // its curve has folds at R_n of about 1.1 and 1.45
  static const Setup setup = [] {
    Setup i;
    i.parameters.k_r = 5;
    i.parameters.C = chi_C_peak_at_V_s(i.parameters.A);
    i.orientation.rtol = 0.005;
    i.integrator = {1e-5, 1e-7};
    return i;
  }();
  return setup;
}

bool on(const CurveNode& node, Branch path) { return node.branch == path || node.branch == Branch::both; }

}  // namespace

TEST_CASE("a traced curve has descending gaps and the requested resolution except at jumps") {
  const Trace trace{0.05, 0.03, 160};
  const auto curve = trace_curve(folded_setup(), trace, make_runner(Engine::fast));
  REQUIRE(curve.size() > 30);
  REQUIRE(long(curve.size()) <= trace.nodes);
  CHECK(curve.front().result.z_0 == Approx(std::sin(folded_setup().parameters.phi_0)));
  CHECK(curve.back().result.z_0 == Approx(trace.to));
  for (std::size_t i = 1; i + 1 < curve.size(); ++i) {
    const PointResult &a = curve[i - 1].result, &b = curve[i].result, &c = curve[i + 1].result;
    REQUIRE(b.z_0 < a.z_0);
    const double share = (b.z_0 - a.z_0) / (c.z_0 - a.z_0);
    const double off = b.value[R_N] - (a.value[R_N] + share * (c.value[R_N] - a.value[R_N]));
    const double noise = a.error[R_N] + b.error[R_N] + c.error[R_N];
    CAPTURE(b.z_0, off);
    CHECK((std::abs(off) <= trace.resolution * std::max(b.value[R_N], 0.1) + noise ||
           std::min(a.z_0 - b.z_0, b.z_0 - c.z_0) <= 2 * kClosest));
  }
}

TEST_CASE("a traced curve has at most the given number of nodes, including folds and landings") {
  Setup rough = folded_setup();
  rough.parameters.k_r = 20;
  const auto curve = trace_curve(rough, {0.05, 0.005, 96}, make_runner(Engine::fast));
  CHECK(curve.size() <= 96);
  long unresolved = 0;
  for (const CurveNode& node : curve) unresolved += node.result.status == PointStatus::not_converged;
  CHECK(unresolved > 0);
}

TEST_CASE("a traced curve ends although some of its nodes are incomplete, and marks their neighbours") {
  Setup limited = folded_setup();
  limited.parameters.k_r = 10;
  limited.integrator.max_evaluations = 45'000;
  const auto curve = trace_curve(limited, {0.01, 0.02, 200}, make_runner(Engine::fast));
  CHECK(curve.size() <= 200);
  const auto count = [&](PointStatus status) {
    return std::count_if(curve.begin(), curve.end(),
                         [&](const auto& node) { return node.result.status == status; });
  };
  CHECK(count(PointStatus::incomplete) > 0);
  CHECK(count(PointStatus::not_converged) > 0);
  CHECK(count(PointStatus::ok) > 10);
}

TEST_CASE(
    "the load increases along the loading path and decreases along the unloading path, with nodes at folds "
    "and landings") {
  const auto curve = trace_curve(folded_setup(), {0.05, 0.03, 160}, make_runner(Engine::fast));
  double top = 0;
  std::size_t last = 0;
  bool jumped = false;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (!on(curve[i], Branch::loading)) continue;
    const PointResult& r = curve[i].result;
    const double allowed = 2 * r.error[R_N] + 0.25 * 0.03 * top;
    CHECK(r.value[R_N] > top - allowed);
    if (i > last + 1 && r.value[R_N] < 1.3) {  // a landing carries the load of the fold
      jumped = true;
      CHECK(r.value[R_N] == Approx(top).epsilon(0.02));
    }
    top = std::max(top, r.value[R_N]);
    last = i;
  }
  CHECK(jumped);
  double bottom = INFINITY;
  for (auto node = curve.rbegin(); node != curve.rend(); ++node) {
    if (!on(*node, Branch::unloading)) continue;
    CHECK(node->result.value[R_N] < bottom * 1.01 + 2 * node->result.error[R_N]);
    bottom = std::min(bottom, node->result.value[R_N]);
  }
}

}  // namespace bristle::trace_test
