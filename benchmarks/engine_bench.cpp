// Compares the speed of the SIMD engine with other solvers at equal measured error. Writes JSON to standard
// output, from which python/bristle/pages/performance.py generates the document. --quick is a test: it
// runs each solver once, measures only the ratio to the reference engine, which is based on Boost.Odeint, and
// fails if the ratio is below --per-lane times the number of SIMD lanes.
#include "bristle/dynamics/ode.hpp"
#include "odeint_peers.hpp"
#include "sample.hpp"
#ifdef BRISTLE_SUNDIALS
#include "sundials_peers.hpp"
#endif

#include <hwy/targets.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>

using namespace bristle;
using namespace bristle::bench;
using Json = nlohmann::ordered_json;

namespace {

constexpr double kError = 1e-4;  // relative error of the impulses at which solvers are compared
constexpr int kPairs = 7;        // of measured times

using Solver = std::function<std::vector<Passage>(double rtol)>;

struct WorkPoint {
  double rtol, error, ms, evaluations;  // ms and evaluations per bristle; evaluations is 0 if not counted
};

std::vector<WorkPoint> work_precision(const Solver& solve, const std::vector<Passage>& exact,
                                      const std::vector<double>& tolerances) {
  std::vector<WorkPoint> curve;
  for (const double rtol : tolerances) {
    std::vector<Passage> result;
    std::vector<double> times;
    for (int i = 0; i < 3; ++i) times.push_back(seconds([&] { result = solve(rtol); }));
    double evaluations = 0;
    for (const Passage& p : result) evaluations += double(p.evaluations) / double(result.size());
    curve.push_back(
        {rtol, impulse_error(result, exact), 1e3 * median(times) / double(exact.size()), evaluations});
  }
  return curve;
}

// The tolerance at which the error of the curve is kError, by logarithmic interpolation.
double tolerance_at_error(const std::vector<WorkPoint>& curve) {
  for (std::size_t i = 1; i < curve.size(); ++i) {
    if (curve[i].error > kError) continue;
    const double u = std::log(kError / curve[i - 1].error) / std::log(curve[i].error / curve[i - 1].error);
    return curve[i - 1].rtol * std::pow(curve[i].rtol / curve[i - 1].rtol, std::clamp(u, 0.0, 1.0));
  }
  return curve.back().rtol;
}

double paired_ratio(const std::function<void()>& peer, const std::function<void()>& ours) {
  std::vector<double> ratios;
  for (int i = 0; i < kPairs; ++i) {
    const double own = seconds(ours);
    ratios.push_back(seconds(peer) / own);
  }
  return median(ratios);
}

Json as_json(const std::vector<WorkPoint>& curve) {
  Json out = Json::array();
  for (const WorkPoint& p : curve)
    out.push_back(
        {{"rtol", p.rtol}, {"error", p.error}, {"ms_per_bristle", p.ms}, {"evaluations", p.evaluations}});
  return out;
}

struct Peer {
  std::string name;
  Solver solve;
  std::vector<double> tolerances;
};

// The solvers to compare, on these bristles, which must outlive them.
std::vector<Peer> make_peers(const Bristles& bristles) {
  const std::vector<double> usual = {1e-3, 1e-4, 1e-5, 1e-6, 1e-7}, tight = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8};
  std::vector<Peer> peers;
  for (const Kernels* kernels : available_kernels())
    peers.push_back({fmt::format("lanes, {}", kernels->target),
                     [&bristles, kernels](double rtol) { return run_lanes(*kernels, bristles.at(rtol)); },
                     usual});
  const auto run = [](OdeintPeer integrate, const std::vector<PassageTask>& tasks) {
    std::vector<Passage> out(tasks.size());
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      out[i].end = pack(state_at_rest(tasks[i].bristle, tasks[i].start));
      const OdeintExit exit = integrate(tasks[i], out[i].end);
      out[i].contact_time = exit.time;
      out[i].evaluations = exit.evaluations;
    }
    return out;
  };
  peers.push_back({"Boost.Odeint, Dormand-Prince 5",
                   [&bristles, run](double rtol) { return run(odeint_dopri5, bristles.for_peers(rtol)); },
                   usual});
  peers.push_back({"Boost.Odeint, Cash-Karp 5",
                   [&bristles, run](double rtol) { return run(odeint_cash_karp, bristles.for_peers(rtol)); },
                   usual});
  peers.push_back(
      {"the reference engine (Odeint, dense output)",
       [&bristles](double rtol) { return run_odeint(bristles.for_peers(rtol, Method::explicit_only)); },
       usual});
#ifdef BRISTLE_SUNDIALS
  peers.push_back({"SUNDIALS ARKODE, Dormand-Prince 5",
                   [&bristles](double rtol) { return run_arkode(bristles.for_peers(rtol)); }, usual});
  peers.push_back({"SUNDIALS CVODE, BDF",
                   [&bristles](double rtol) { return run_cvode(bristles.for_peers(rtol)); }, tight});
#endif
  return peers;
}

// Bristles that do not reach the pole.
Bristles ordinary_bristles() { return {256, 1.8}; }

// Compares the solvers on bristles that do not reach the pole, as only the engines of this project have a
// pole rule.
Json ordinary() {
  const Bristles bristles = ordinary_bristles();
  const auto exact = run_lanes(best_kernels(), bristles.at(1e-11));
  const auto fast = [&](double rtol) { return run_lanes(best_kernels(), bristles.at(rtol)); };
  const double own_rtol = tolerance_at_error(work_precision(fast, exact, {1e-3, 1e-4, 1e-5, 1e-6, 1e-7}));
  Json out = Json::array();
  for (const Peer& peer : make_peers(bristles)) {
    fmt::print(stderr, "{} ...\n", peer.name);
    const auto curve = work_precision(peer.solve, exact, peer.tolerances);
    const double rtol = tolerance_at_error(curve);
    const double ratio = paired_ratio([&] { peer.solve(rtol); }, [&] { fast(own_rtol); });
    out.push_back({{"name", peer.name}, {"ratio_at_1e-4", ratio}, {"curve", as_json(curve)}});
  }
  return out;
}

// All bristles, including pinned and reflected ones. The reference engine uses its implicit method for stiff
// bristles.
Json all_kinds(int count, double rtol, double odeint_rtol) {
  const Bristles bristles(count, M_PI);
  const auto exact = run_lanes(best_kernels(), bristles.at(1e-9));
  std::vector<Passage> ours, odeint;
  SimdEngine::Usage usage;
  const double ratio = paired_ratio([&] { odeint = run_odeint(bristles.for_peers(odeint_rtol)); },
                                    [&] { ours = run_lanes(best_kernels(), bristles.at(rtol), &usage); });
  const double own = seconds([&] { run_lanes(best_kernels(), bristles.at(rtol)); });
  return {{"bristles", count},
          {"ratio", ratio},
          {"error", impulse_error(ours, exact)},
          {"odeint_error", impulse_error(odeint, exact)},
          {"ms_per_bristle", 1e3 * own / count},
          {"lane_utilisation", usage.passage_steps / usage.lane_steps}};
}

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(": ") + 2);
  return "unknown";
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Speed of the SIMD engine compared with other solvers");
  bool quick = false;
  double per_lane = 0;
  app.add_flag("--quick", quick, "measure only the ratio to the reference engine");
  app.add_option("--per-lane", per_lane,
                 "with --quick: fail if the ratio is below this times the number of SIMD lanes");
  CLI11_PARSE(app, argc, argv);
  // On this sample the fast engine and Odeint have about equal errors at these tolerances.
  constexpr double rtol = 1e-5, odeint_rtol = 1e-4;
  if (quick) {
    // Every solver must end every passage, also with its loosest tolerance.
    const Bristles bristles = ordinary_bristles();
    for (const Peer& peer : make_peers(bristles)) peer.solve(peer.tolerances.front());
    const Json result = all_kinds(1024, rtol, odeint_rtol);
    const double ratio = result["ratio"], least = per_lane * best_kernels().width;
    fmt::print(
        "{}, {}: the fast engine is {:.1f} times as fast as the reference engine (required: {:.1f}), at "
        "errors of "
        "{:.1e} and {:.1e}\n",
        processor(), best_kernels().target, ratio, least, result["error"].get<double>(),
        result["odeint_error"].get<double>());
    return ratio >= least ? 0 : 1;
  }
  Json out;
  out["processor"] = processor();
  out["instruction_set"] = best_kernels().target;
  out["ordinary"] = ordinary();
  out["all_kinds"] = all_kinds(1984, rtol, odeint_rtol);
  fmt::print("{}\n", out.dump(1));
}
