// Measures the errors of the integration, the error estimates of the quadrature, the standard errors of the
// lattice, and the stiffness of the equations. The numbers do not depend on the processor or on time. Writes
// JSON to standard output, from which python/bristle/pages/accuracy.py generates docs/generated/accuracy.md.
#include "bristle/dynamics/jacobian.hpp"
#include "bristle/ensemble/lattice.hpp"
#include "bristle/ensemble/point.hpp"
#include "bristle/model/elementary.hpp"
#include "sample.hpp"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <array>
#include <future>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>

using namespace bristle;
using Json = nlohmann::ordered_json;

namespace {

struct Case {
  double k_r, k_theta, z_0;
};
constexpr Case kCases[] = {{10, 1, 0.1}, {25, 1, 0.5}, {50, 1, 0.62}};

constexpr Observable kControlled[] = {N_C_RATIO, R_N, R_X, GAMMA_1, GAMMA_2, GAMMA_3};

const PassageRunner& runner(Engine engine) {
  static const PassageRunner fast = make_runner(Engine::fast), reference = make_runner(Engine::reference);
  return engine == Engine::fast ? fast : reference;
}

const char* engine_name(Engine engine) { return engine == Engine::fast ? "fast" : "reference"; }

Setup setup_of(const Case& c, double rtol = 1e-4) {
  Setup setup;
  setup.parameters.k_r = c.k_r;
  setup.parameters.k_theta = c.k_theta;
  setup.parameters.C = chi_C_peak_at_V_s(setup.parameters.A);
  setup.integrator = {rtol, 2 * rtol, Method::automatic, 200'000'000};
  return setup;
}

// The mean over equidistant azimuths, which are the same at every tolerance, so that only integration causes
// errors.
ObservableArray mean_over_grid(const Case& c, double rtol, Engine engine) {
  constexpr int kAzimuths = 200;
  Setup setup = setup_of(c, rtol);
  setup.orientation.sampling = Sampling::list;
  for (int i = 0; i < kAzimuths; ++i) setup.orientation.theta_0.push_back(M_PI * (i + 0.5) / kAzimuths);
  return EnsembleMean(setup, c.z_0, runner(engine)).full().mean;
}

// Relative errors of the means with respect to Odeint at 1e-9; the largest of all cases.
Json integration() {
  Json rows = Json::array();
  std::vector<ObservableArray> exact;
  for (const Case& c : kCases) exact.push_back(mean_over_grid(c, 1e-9, Engine::reference));
  for (const Engine engine : {Engine::fast, Engine::reference})
    for (const double rtol : {1e-4, 3e-5, 1e-5, 1e-6}) {
      Json row = {{"engine", engine_name(engine)}, {"rtol", rtol}};
      ObservableArray worst{};
      for (std::size_t i = 0; i < std::size(kCases); ++i) {
        const ObservableArray mean = mean_over_grid(kCases[i], rtol, engine);
        for (const Observable k : kControlled)
          worst[k] = std::max(worst[k], std::abs(mean[k] / exact[i][k] - 1));
      }
      for (const Observable k : kControlled) row[kObservables[k].name] = worst[k];
      rows.push_back(row);
    }
  return rows;
}

// Errors of single bristles of all kinds at the default tolerance, separately for those that stayed far from
// the pole ("explicit") and those that came near it ("implicit").
Json bristles() {
  const bench::Bristles sample(496, M_PI);
  const auto exact = bench::run_odeint(sample.at(1e-9));
  const auto fast = runner(Engine::fast)(sample.at(1e-4));
  std::vector<Passage> fast_by_method[2], exact_by_method[2];  // explicit, implicit
  for (std::size_t i = 0; i < fast.size(); ++i) {
    fast_by_method[fast[i].implicit].push_back(fast[i]);
    exact_by_method[fast[i].implicit].push_back(exact[i]);
  }
  return {{"explicit", fast_by_method[0].size()},
          {"explicit_error", bench::impulse_error(fast_by_method[0], exact_by_method[0])},
          {"implicit", fast_by_method[1].size()},
          {"implicit_error", bench::impulse_error(fast_by_method[1], exact_by_method[1])}};
}

// Contact time of the bristle with theta_0 = pi at tolerances from 1e-5 to 1e-8: the largest relative scatter
// of all cases, and the largest number of reflections.
Json head_on() {
  Json out;
  for (const Engine engine : {Engine::fast, Engine::reference}) {
    double scatter = 0;
    int reflections = 0;
    for (const Case& c : kCases) {
      double least = INFINITY, most = 0;
      for (const double rtol : {1e-5, 1e-6, 1e-7, 1e-8}) {
        const Setup setup = setup_of(c, rtol);
        const auto b = make_bristle(setup.parameters, c.z_0, M_PI);
        const PassageTask task{&setup.parameters, b, static_equilibrium(b), setup.integrator};
        const Passage p = runner(engine)({task}).front();
        least = std::min(least, p.contact_time);
        most = std::max(most, p.contact_time);
        reflections = std::max(reflections, p.reflections);
      }
      scatter = std::max(scatter, most / least - 1);
    }
    const char* name = engine_name(engine);
    out["scatter"][name] = scatter;
    out["reflections"][name] = reflections;
  }
  return out;
}

// The value below which half of the weight lies.
double weighted_median(std::vector<std::pair<double, double>> values_and_weights) {
  std::sort(values_and_weights.begin(), values_and_weights.end());
  double all = 0, below = 0;
  for (const auto& [value, weight] : values_and_weights) all += weight;
  for (const auto& [value, weight] : values_and_weights)
    if ((below += weight) >= all / 2) return value;
  return NAN;
}

// The fastest decay rate (minus the most negative eigenvalue) along passages: for each case, the ranges over
// bristles of its median over the time in contact and of its maximum.
Json stiffness() {
  Json rows = Json::array();
  for (const Case& c : kCases) {
    std::vector<double> medians, peaks;
    for (int degrees = 5; degrees < 180; degrees += 10) {
      const Setup setup = setup_of(c);
      const auto b = make_bristle(setup.parameters, c.z_0, degrees * M_PI / 180);
      std::vector<std::pair<double, double>> decays;
      double last = 0;
      const auto observe = [&](double xi, const OdeState& y) {
        Jacobian J;
        jacobian(b, y, J);
        Eigen::Matrix<double, kState, kState> of_state;
        for (int i = 0; i < kState; ++i)
          for (int j = 0; j < kState; ++j) of_state(i, j) = J[i][j];
        decays.emplace_back(-of_state.eigenvalues().real().minCoeff(), xi - last);
        last = xi;
      };
      run_passage({&setup.parameters, b, static_equilibrium(b), setup.integrator}, observe);
      medians.push_back(weighted_median(decays));
      peaks.push_back(std::max_element(decays.begin(), decays.end())->first);
    }
    const auto range = [](const std::vector<double>& v) {
      const auto [least, most] = std::minmax_element(v.begin(), v.end());
      return Json{*least, *most};
    };
    rows.push_back({{"k_r", c.k_r}, {"z_0", c.z_0}, {"median", range(medians)}, {"peak", range(peaks)}});
  }
  return rows;
}

// How often the difference between a mean and a finer one is within the sum of their error estimates.
Json quadrature() {
  struct Row {
    double rtol;
    int within = 0, within_two = 0;
    double worst = 0;
  };
  Row rows[] = {{1e-3}, {3e-3}};
  int values = 0;
  for (const double k_r : {2., 3., 5., 8., 13., 22., 36., 60., 100.})
    for (const double k_theta : {1., 5.})
      for (const double z_0 : {0.1, 0.3, 0.5, 0.7, 0.9}) {
        const Case c{k_r, k_theta, z_0};
        Setup setup = setup_of(c), fine = setup;
        fine.orientation.rtol = 2e-4;
        EnsembleMean exact_mean(fine, z_0, runner(Engine::fast));
        const Ensemble& exact = exact_mean.full();
        values += int(std::size(kControlled));
        for (Row& row : rows) {
          setup.orientation.rtol = row.rtol;
          EnsembleMean mean(setup, z_0, runner(Engine::fast));
          const Ensemble& e = mean.full();
          for (const Observable k : kControlled) {
            const double units = std::abs(e.mean[k] - exact.mean[k]) / (e.error[k] + exact.error[k]);
            row.within += units <= 1;
            row.within_two += units <= 2;
            row.worst = std::max(row.worst, units);
          }
        }
      }
  Json out = {{"values", values}, {"rows", Json::array()}};
  for (const Row& row : rows)
    out["rows"].push_back(
        {{"rtol", row.rtol}, {"within", row.within}, {"within_two", row.within_two}, {"worst", row.worst}});
  return out;
}

// Random points at given gaps: near the paper's values, or over the range of the schema.
struct RandomPoint {
  Setup setup;
  double z_0;
};

RandomPoint random_point(bool near_paper, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto share = [&] { return double(random() >> 11) * 0x1p-53; };
  const auto uniform = [&](double from, double to) { return from + (to - from) * share(); };
  const auto logarithmic = [&](double from, double to) {
    return bristle::exp(uniform(bristle::log(from), bristle::log(to)));
  };
  Setup setup = setup_of({}, 1e-4);
  Parameters& p = setup.parameters;
  p.friction = share() < 0.5 ? FrictionLaw::nss : FrictionLaw::coulomb;
  p.bending = share() < 0.5 ? Bending::polar : Bending::polar_as_printed;
  if (near_paper) {
    p.k_r = logarithmic(4, 200);
    p.k_theta = logarithmic(0.1, 3);
    p.k_phi = uniform(1, 4);
    p.phi_0 = uniform(72, 84) * M_PI / 180;
    p.tau_f = logarithmic(5e3, 6e4);
    p.mu_c = logarithmic(0.3, 8);
  } else {
    p.k_r = logarithmic(1, 1000);
    p.k_theta = logarithmic(0.05, 20);
    p.k_phi = logarithmic(0.1, 10);
    p.phi_0 = uniform(30, 87) * M_PI / 180;
    p.tau_f = logarithmic(1e3, 3e5);
    p.mu_c = logarithmic(0.1, 10);
    p.L_x = logarithmic(0.5, 10);
    p.V_s = logarithmic(1e-3, 0.1);
    constexpr InitialState states[] = {InitialState::static_equilibrium, InitialState::static_equilibrium,
                                       InitialState::at_slab, InitialState::unstretched,
                                       InitialState::upright};
    p.initial_state = states[random() % std::size(states)];
    p.pole_rule = share() < 0.8 ? PoleRule::reflect : PoleRule::cross;
    p.alpha = share() < 0.3 ? 0 : logarithmic(0.01, 3);
    p.lambda = logarithmic(1e-4, 1e-2);
    p.s_min = p.lambda * logarithmic(0.01, 1);
    setup.orientation.rtol = logarithmic(1e-3, 2e-2);
  }
  return {setup, uniform(0.05, 0.98) * bristle::sin(p.phi_0)};
}

// Values of bristles by azimuth, from 0 to pi.
using Curve = std::map<double, std::pair<Outcome, ObservableArray>>;

ObservableArray trapezoids(const Curve& curve, std::size_t stride) {
  ObservableArray mean{};
  auto left = curve.begin();
  while (std::next(left) != curve.end()) {
    auto right = left;
    for (std::size_t i = 0; i < stride && std::next(right) != curve.end(); ++i) ++right;
    for (std::size_t k = 0; k < OBSERVABLES; ++k)
      mean[k] +=
          (left->second.second[k] + right->second.second[k]) * (right->first - left->first) / (2 * M_PI);
    left = right;
  }
  return mean;
}

// The bristles of 2161 equidistant azimuths at a tenth of the integrator's tolerance, and those between which
// the outcome changes, closer and closer. None if a passage fails.
std::optional<Curve> dense(const RandomPoint& point) {
  constexpr int kAzimuths = 2160, kHalvings = 10, kMostChanges = 200;
  Setup setup = point.setup;
  setup.integrator.rtol /= 10;
  setup.integrator.atol /= 10;
  const Equilibrium start = InitialStates(setup.parameters).at(point.z_0);
  Curve curve;
  const auto compute = [&](const std::vector<double>& azimuths) {
    std::vector<PassageTask> tasks;
    for (const double theta_0 : azimuths)
      tasks.push_back(
          {&setup.parameters, make_bristle(setup.parameters, point.z_0, theta_0), start, setup.integrator});
    bool complete = true;
    for (const Passage& one : runner(Engine::fast)(tasks)) {
      complete = complete && one.complete();
      curve[one.theta_0] = {one.outcome, observables(one, setup.parameters)};
    }
    return complete;
  };
  std::vector<double> azimuths;
  for (int i = 0; i <= kAzimuths; ++i) azimuths.push_back(M_PI * i / kAzimuths);
  if (!compute(azimuths)) return {};
  for (int halving = 0; halving < kHalvings; ++halving) {
    azimuths.clear();
    for (auto right = std::next(curve.begin()); right != curve.end(); ++right)
      if (const auto left = std::prev(right); left->second.first != right->second.first)
        azimuths.push_back((left->first + right->first) / 2);
    if (azimuths.empty() || azimuths.size() > kMostChanges) break;
    if (!compute(azimuths)) return {};
  }
  return curve;
}

// How often the difference between a mean at a random point and that of many equidistant azimuths is within
// the error estimates; that of the azimuths is the difference to every second one.
Json random_means(bool near_paper) {
  constexpr int kPoints = 300;
  const std::vector<std::size_t> shown = {
      R_N, R_X, N_C_RATIO, GAMMA_1, GAMMA_2, GAMMA_3, PINNED_FRACTION, unpinned(R_N), unpinned(R_X)};
  int points = 0, values = 0, within[3] = {};
  long passages = 0;
  for (int i = 0; i < kPoints; ++i) {
    const RandomPoint point = random_point(near_paper, std::uint64_t(i + 1));
    const auto curve = dense(point);
    if (!curve) continue;
    EnsembleMean mean(point.setup, point.z_0, runner(Engine::fast));
    const Ensemble& e = mean.with_integrator_error();
    if (values_of(point.setup.parameters, e).status != PointStatus::ok) continue;
    ++points;
    passages += e.passages;
    const ObservableArray exact = trapezoids(*curve, 1), half = trapezoids(*curve, 2);
    for (const std::size_t k : shown) {
      const double apart = std::abs(e.mean[k] - exact[k]), rounding = 1e-9 * std::max(1., std::abs(exact[k]));
      const double error = e.error[k] + std::abs(half[k] - exact[k]) / 3;
      ++values;
      for (int j = 0; j < 3; ++j) within[j] += apart <= std::max(rounding, (std::array{1, 2, 8})[j] * error);
    }
  }
  return {{"near", near_paper},
          {"points", points},
          {"values", values},
          {"within", within[0]},
          {"within_two", within[1]},
          {"beyond_eight", values - within[2]},
          {"passages", double(passages) / points}};
}

Json azimuths_between_nodes() {
  auto whole = std::async(std::launch::async, random_means, false);
  const Json near_paper = random_means(true);
  return {near_paper, whole.get()};
}

// Root mean square over seeds of the deviation of the lattice mean from the mean over theta_0, in standard
// errors.
Json lattice() {
  constexpr int kSeeds = 40, kDraws = 3000;
  constexpr Observable kShown[] = {R_N, R_X, R_Y, N_C_RATIO, GAMMA_1};
  constexpr const char* kShownNames[] = {"R_n", "R_x", "R_y", "N_c_ratio", "gamma_1"};
  Setup setup = setup_of({10, 1, 0.115});
  const Ensemble mean = EnsembleMean(setup, 0.115, runner(Engine::fast)).full();
  setup.parameters.L_y = 5;
  setup.orientation.sampling = Sampling::lattice;
  setup.orientation.rows = 120;
  setup.orientation.t_1 = -1;
  ObservableArray squares{};
  // Squares of the standardised sum of sin(theta_0), in which R_y is odd: the deviation due to the azimuths
  // alone.
  double sine_squares = 0, of_seeds = 0;
  const long bristles = 120 * 25;
  for (int seed = 1; seed <= kDraws; ++seed) {
    setup.orientation.seed = std::uint64_t(seed);
    double sum = 0;
    for (long i = 0; i < bristles; ++i) sum += std::sin(random_azimuth(setup.orientation, std::uint64_t(i)));
    sine_squares += sum * sum / (0.5 * double(bristles));
    if (seed == kSeeds) of_seeds = sine_squares;
    if (seed > kSeeds) continue;
    const LatticeMean l = lattice_mean(setup, 0.115, runner(Engine::fast));
    for (const Observable k : kShown) {
      const double units = (l.mean[k] - mean.mean[k]) / l.error[k];
      squares[k] += units * units;
    }
  }
  Json out = {{"seeds", kSeeds}, {"rows", 120}, {"bristles", bristles}};
  for (std::size_t k = 0; k < std::size(kShown); ++k)
    out["deviation"][kShownNames[k]] = std::sqrt(squares[kShown[k]] / kSeeds);
  out["azimuths"] = {
      {"seeds", std::sqrt(of_seeds / kSeeds)}, {"draws", kDraws}, {"all", std::sqrt(sine_squares / kDraws)}};
  return out;
}

}  // namespace

int main() {
  Json out;
  const auto measure = [&](const char* name, Json (*what)()) {
    fmt::print(stderr, "accuracy: {} ...\n", name);
    out[name] = what();
  };
  measure("integration", integration);
  measure("bristles", bristles);
  measure("head_on", head_on);
  measure("stiffness", stiffness);
  measure("quadrature", quadrature);
  measure("random_means", azimuths_between_nodes);
  measure("lattice", lattice);
  fmt::print("{}\n", out.dump(1));
}
