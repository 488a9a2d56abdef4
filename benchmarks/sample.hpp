#pragma once

#include "bristle/model/equilibrium.hpp"
#include "bristle/model/friction/laws.hpp"
#include "bristle/simd/dispatch.hpp"
#include "bristle/simd/engine.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <functional>
#include <random>

namespace bristle::bench {

// Random bristles within the ranges of the paper, with both friction laws; the same on every machine and in
// every run.
class Bristles {
 public:
  // largest_theta_0: rad, pi for all bristles; below about 1.8 none is pinned.
  Bristles(int count, double largest_theta_0, Bending bending = Bending::polar,
           Contact contact = Contact::wall) {
    std::mt19937_64 random(1);
    const auto uniform = [&](double from, double to) {
      return from + (to - from) * double(random() >> 11) * 0x1p-53;
    };
    const auto log_uniform = [&](double from, double to) {
      return std::exp(uniform(std::log(from), std::log(to)));
    };
    for (int i = 0; i < count; ++i) {
      Parameters& p = parameters_.emplace_back();
      p.bending = bending;
      p.contact = contact;
      p.friction = i % 2 ? FrictionLaw::nss : FrictionLaw::coulomb;
      p.k_r = log_uniform(2, 100);
      p.k_theta = log_uniform(0.3, 10);
      p.k_phi = uniform(1.5, 3.5);
      p.C = chi_C_peak_at_V_s(p.A);
      const auto b = make_bristle(p, uniform(0.1, 0.95), uniform(0, largest_theta_0));
      tasks_.push_back({&p, b, static_equilibrium(b), {}});
    }
  }

  // With the ratio of tolerances that suits the SIMD engine, and with one that suits other solvers.
  std::vector<PassageTask> at(double rtol, Method method = Method::automatic) const {
    return with({rtol, 2 * rtol, method, 200'000'000});
  }
  std::vector<PassageTask> for_peers(double rtol, Method method = Method::automatic) const {
    return with({rtol, rtol / 100, method, 200'000'000});
  }

 private:
  std::vector<PassageTask> with(const IntegratorOptions& options) const {
    std::vector<PassageTask> tasks = tasks_;
    for (PassageTask& task : tasks) task.integrator = options;
    return tasks;
  }

  std::deque<Parameters> parameters_;
  std::vector<PassageTask> tasks_;
};

inline std::vector<Passage> run_lanes(const Kernels& kernels, const std::vector<PassageTask>& tasks,
                                      SimdEngine::Usage* usage = nullptr) {
  std::vector<Passage> out(tasks.size());
  SimdEngine engine(kernels, [&](std::size_t ticket, Passage&& p) { out[ticket] = std::move(p); });
  for (std::size_t i = 0; i < tasks.size(); ++i) engine.submit(tasks[i], i);
  while (engine.advance()) {
  }
  if (usage) *usage = engine.usage();
  return out;
}

inline std::vector<Passage> run_odeint(const std::vector<PassageTask>& tasks) {
  std::vector<Passage> out;
  for (const PassageTask& task : tasks) out.push_back(run_passage(task));
  return out;
}

// The 90th percentile over bristles of the relative error of the impulses of normal force and friction.
inline double impulse_error(const std::vector<Passage>& passages, const std::vector<Passage>& exact) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < passages.size(); ++i) {
    double worst = 0;
    for (const int c : {component::NORMAL, component::FRICTION_X})
      worst = std::max(worst, std::abs(passages[i].end[c] / exact[i].end[c] - 1));
    errors.push_back(worst);
  }
  std::sort(errors.begin(), errors.end());
  return errors[errors.size() * 9 / 10];
}

inline double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace bristle::bench
