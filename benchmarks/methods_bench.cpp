// Compares classes of methods for the passage of one bristle, in scalar code: additive Runge-Kutta pairs,
// among them the engine's, an explicit pair, a stabilised explicit method, a linearly implicit method and an
// exponential integrator. They have the equations, the step size control, the norm of the error and the rule
// for the exit in common. Writes JSON to standard output, from which scripts/performance.py makes a table.
// --orders instead prints the order of convergence of each method, which tests its coefficients.
#include "methods.hpp"
#include "sample.hpp"

#include "dynamics/rules.hpp"
#include "simd/hermite.hpp"

#include <CLI/CLI.hpp>
#include <bit>
#include <ctime>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace bristle;
using namespace bristle::bench;
using Json = nlohmann::ordered_json;

namespace {

constexpr long kMaxAttempts = 200'000;  // of steps of one passage

// The largest ratio of error to tolerance; NaN if any error is NaN.
double error_norm(const OdeState& y, const OdeState& error, double rtol, double atol) {
  double largest = 0, sum = 0;
  for (int c = 0; c < kComponents; ++c) {
    const double size = std::abs(error[c]);
    largest = std::max(largest, size / (atol * tolerance_scale(c) + rtol * std::abs(y[c])));
    sum += size;
  }
  return largest + (sum - sum);
}

// The engine's rough_power() and next_size(), of simd/group.hpp.
double rough_power(double x, double exponent) {
  constexpr auto one = std::bit_cast<std::int64_t>(1.0);
  return std::bit_cast<double>(one + std::int64_t(double(std::bit_cast<std::int64_t>(x) - one) * exponent));
}
double next_size(double h, double error, double last_error, double exponent) {
  if (!(error < 1e6)) return 0.2 * h;
  const auto power = [](double x, double e) { return rough_power(std::max(x, 1e-4), e); };
  const double factor =
      error < 1 ? power(error, 0.7 * exponent) * power(last_error, -0.4 * exponent) : power(error, exponent);
  return h * std::clamp(0.9 * factor, 0.2, 5.0);
}

struct Result {
  OdeState end;
  long steps = 0, evaluations = 0;
  bool complete = false;
};

template <class M>
Result integrate(const PassageTask& task, const ModulationTable& table) {
  Problem p{task.bristle, table};
  const double rtol = task.integrator.rtol, atol = task.integrator.atol, L_x = task.parameters->L_x;
  OdeState y = pack(state_at_rest(task.bristle, task.start));
  const double x_0 = y[X];
  double t = 0, h = kFirstStep, last_error = 1;
  Evaluation at;
  p.evaluate(y, at);
  Result out;
  Attempt attempt;
  while (++out.steps < kMaxAttempts && h > kSmallestStep) {
    M::attempt(p, y, at, h, attempt);
    const double error = error_norm(y, attempt.error, rtol, atol);
    const double h_next = next_size(h, error, last_error, M::exponent);
    if (!(error < 1)) {
      h = h_next;
      continue;
    }
    const double slip = t + h - (attempt.y[X] - x_0) - L_x;
    if (slip > kSlipTolerance) {  // the next attempt ends at the exit
      const InPlanePath path(y, attempt.y, h);
      h *= first_root([&](double u) { return t + u * h - (path(u)[X] - x_0) - L_x; }, 0, 1, 1e-14);
      continue;
    }
    t += h;
    y = attempt.y;
    if (slip >= -kSlipTolerance) {
      out.complete = true;
      break;
    }
    if (M::gives_next) at = attempt.next;
    else p.evaluate(y, at);
    h = h_next;
    last_error = error;
  }
  out.end = y;
  out.evaluations = p.evaluations;
  return out;
}

// The tables of the friction laws' modulations.
class Tables {
 public:
  const ModulationTable& of(const PassageTask& task) {
    for (const ModulationTable& table : tables_)
      if (table.serves(task.bristle.friction, task.bristle.friction_constants, task.parameters->V_s))
        return table;
    return tables_.emplace_back(task.bristle.friction, task.bristle.friction_constants, task.parameters->V_s);
  }

 private:
  std::deque<ModulationTable> tables_;
};

// The relative error of each bristle's impulses of normal force and friction, in ascending order.
std::vector<double> impulse_errors(const std::vector<Result>& results, const std::vector<Passage>& exact) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < results.size(); ++i) {
    double worst = results[i].complete ? 0 : 1;
    for (const int c : {NORMAL, FRICTION_X})
      worst = std::max(worst, std::abs(results[i].end[c] / exact[i].end[c] - 1));
    errors.push_back(worst);
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

constexpr double kSmallestError = 1e-5;  // where a curve ends

// solve(tasks) returns the results.
template <class Solve>
Json curve(const std::string& name, const Bristles& bristles, const std::vector<Passage>& exact, int repeats,
           Solve solve) {
  fmt::print(stderr, "{} ...\n", name);
  Json points = Json::array();
  for (int half_decade = 2; half_decade <= 16; ++half_decade) {
    const double rtol = std::pow(10, -half_decade / 2.0), n = double(exact.size());
    const auto tasks = bristles.at(rtol);
    std::vector<Result> results;
    std::vector<double> times;
    for (int i = 0; i < repeats; ++i) {
      const std::clock_t start = std::clock();
      results = solve(tasks);
      times.push_back(double(std::clock() - start) / CLOCKS_PER_SEC);
    }
    const auto errors = impulse_errors(results, exact);
    double evaluations = 0, steps = 0;
    for (const Result& r : results) {
      evaluations += double(r.evaluations) / n;
      steps += double(r.steps) / n;
    }
    points.push_back({{"rtol", rtol},
                      {"error", errors[errors.size() * 9 / 10]},
                      {"median_error", errors[errors.size() / 2]},
                      {"evaluations", evaluations},
                      {"steps", steps},
                      {"ms_per_bristle", 1e3 * *std::min_element(times.begin(), times.end()) / n}});
    if (errors[errors.size() / 2] < kSmallestError && errors[errors.size() * 9 / 10] < kSmallestError) break;
  }
  return {{"name", name}, {"curve", points}};
}

// For fixed steps, halved again and again: the largest error of state and integrals at the end, the sum of
// the estimated errors, and their orders, on bristles under a soft wall with friction that changes slowly.
template <class M>
void print_order(const std::vector<PassageTask>& tasks, Tables& tables) {
  constexpr double duration = 1;
  const auto run = [&]<class Method>(Method, const PassageTask& task, int steps, double& estimates) {
    Problem p{task.bristle, tables.of(task)};
    OdeState y = pack(state_at_rest(task.bristle, task.start));
    Attempt attempt;
    estimates = 0;
    for (int i = 0; i < steps; ++i) {
      Evaluation at;
      p.evaluate(y, at);
      Method::attempt(p, y, at, duration / steps, attempt);
      y = attempt.y;
      estimates += error_norm(y, attempt.error, 1, 1);
    }
    return y;
  };
  std::string errors, estimates;
  double last_error = 0, last_estimate = 0;
  for (int steps = 16; steps <= 1024; steps *= 2) {
    double error = 0, estimate = 0;
    for (const PassageTask& task : tasks) {
      double one = 0, unused = 0;
      const OdeState y = run(M(), task, steps, one), exact = run(DormandPrince(), task, 8192, unused);
      for (int c = 0; c < kComponents; ++c) error = std::max(error, std::abs(y[c] - exact[c]));
      estimate = std::max(estimate, one);
    }
    if (last_error > 0) {
      errors += fmt::format("  {:.1e} ({:.2f})", error, std::log2(last_error / error));
      estimates += fmt::format("  {:.1e} ({:.2f})", estimate, std::log2(last_estimate / estimate));
    }
    last_error = error;
    last_estimate = estimate;
  }
  fmt::print("{}\n  errors (orders)   {}\n  estimates (orders){}\n", M::name, errors, estimates);
}

template <class Do>
void for_each_method(Do action) {
  action(Additive<Extrapolated>(), Additive<FromStageBefore>(), Additive<TwoIterations>(),
         Additive<Extrapolated, KennedyCarpenter4Later>(),
         Additive<FromStageBefore, KennedyCarpenter4Later>(),
         Additive<TwoIterations, KennedyCarpenter4Later>(), DormandPrince(), Chebyshev(), Rosenbrock(),
         Exponential());
}

void print_orders() {
  std::deque<Parameters> parameters;
  std::vector<PassageTask> tasks;
  for (const double k_r : {3.0, 10.0, 40.0}) {
    Parameters& p = parameters.emplace_back();
    p.friction = k_r == 10 ? FrictionLaw::coulomb : FrictionLaw::nss;
    p.k_r = k_r;
    p.V_s = 0.5;
    p.lambda_z = 0.1;
    p.beta = 0.2;
    p.C = chi_C_peak_at_V_s(p.A);
    const auto b = make_bristle(p, 0.7, 0.8);
    tasks.push_back({&p, b, static_equilibrium(b), {}});
  }
  Tables tables;
  const auto print = [&]<class... M>(M...) { (print_order<M>(tasks, tables), ...); };
  for_each_method(print);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Work and precision of further classes of methods, in scalar code");
  bool orders = false;
  int count = 256, repeats = 3;
  app.add_flag("--orders", orders, "print the order of convergence of each method");
  app.add_option("--bristles", count, "number of bristles");
  app.add_option("--repeats", repeats, "times are the least of this many");
  CLI11_PARSE(app, argc, argv);
  if (orders) {
    print_orders();
    return 0;
  }
  const Bristles bristles(count, 1.8);
  const auto exact = run_lanes(best_kernels(), bristles.at(1e-11));
  Tables tables;
  Json out = Json::array();
  // The engine, whose errors those of the scalar code of the same method should equal.
  out.push_back(curve("engine", bristles, exact, repeats, [](const std::vector<PassageTask>& tasks) {
    std::vector<Result> results;
    for (const Passage& p : run_lanes(best_kernels(), tasks))
      results.push_back({p.end, p.steps, p.evaluations, p.complete()});
    return results;
  }));
  const auto add = [&]<class... M>(M...) {
    (out.push_back(curve(M::name, bristles, exact, repeats,
                         [&](const std::vector<PassageTask>& tasks) {
                           std::vector<Result> results;
                           for (const PassageTask& task : tasks)
                             results.push_back(integrate<M>(task, tables.of(task)));
                           return results;
                         })),
     ...);
  };
  for_each_method(add);
  fmt::print("{}\n", out.dump(1));
}
