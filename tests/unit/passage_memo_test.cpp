#include "run/passage_memo.hpp"

#include "bristle/model/friction/table.hpp"
#include "bristle/simd/runner.hpp"
#include "run/passage_queue.hpp"
#include "generators.hpp"
#include "scratch.hpp"
#include "experiment/experiment.hpp"

#include <array>
#include <cstring>
#include <functional>
#include <set>
#include <thread>

namespace bristle::passage_memo_test {
using namespace testing;
using run::PassageMemo;
using run::PassageQueue;
using run::PassageRequest;
using run::RequestKey;

namespace {

Experiment loaded(const Scratch& s, const std::string& more) {
  s.write("paper.json", bytes_of(std::string(BRISTLE_EXPERIMENTS) + "/paper.json"));
  return load_experiment(s.write("e.json", R"({"extends": "paper.json", "name": "e", )" + more + "}"), {});
}

// Returns a sweep over two loads of one brush, the default one.
Sweep two_loads() {
  Sweep sweep;
  sweep.axes = {{"R_n", {1, 2}}};
  return sweep;
}

// Returns the parameters of every point of the sweep.
Parameters parameters_of(const Sweep& sweep) { return sweep.point(0).setup.parameters; }

PassageTask task_of(const Parameters& p, double z_0 = 0.5, double theta_0 = 1) {
  return {&p, make_bristle(p, z_0, theta_0), {0.9, 0.6}, {}};
}

// Returns tasks of one gap at the azimuths first, first + 1, ...
std::vector<PassageTask> tasks_of(const Parameters& p, int first, int count) {
  std::vector<PassageTask> out;
  for (int i = first; i < first + count; ++i) out.push_back(task_of(p, 0.5, i));
  return out;
}

// Computes a chunk: each passage has the azimuth of its task. Returns the number of passages.
std::size_t compute(PassageQueue& queue, const run::PassageChunk& chunk) {
  for (std::size_t i = chunk.first; i < chunk.last; ++i) {
    Passage passage;
    passage.theta_0 = (*chunk.tasks)[i].bristle.theta_0;
    queue.deliver(*chunk.request, i, std::move(passage));
  }
  return chunk.last - chunk.first;
}

std::size_t compute_all(PassageQueue& queue) {
  std::size_t computed = 0;
  while (const auto chunk = queue.take(0)) computed += compute(queue, *chunk);
  return computed;
}

void check_azimuths(PassageRequest& request, const std::vector<PassageTask>& tasks) {
  REQUIRE(request.complete());
  const std::vector<Passage> passages = request.take();
  REQUIRE(passages.size() == tasks.size());
  for (std::size_t i = 0; i < tasks.size(); ++i) CHECK(passages[i].theta_0 == tasks[i].bristle.theta_0);
}

}  // namespace

TEST_CASE("memo of passages: every number of a task changes the key of its request") {
  PassageMemo memo;
  const Sweep sweep = two_loads();
  memo.share(sweep, {0, 1});
  const Parameters p = parameters_of(sweep);
  const auto key = [&](const std::function<void(PassageTask&)>& change) {
    PassageTask task = task_of(p);
    change(task);
    return memo.key_of({task_of(p), task}, Engine::fast);
  };
  const std::set<RequestKey> keys = {
      key([](PassageTask&) {}),
      key([](PassageTask& t) { t.bristle.z_0 = 0.6; }),
      key([](PassageTask& t) { t.bristle.theta_0 = 0; }),
      key([](PassageTask& t) { t.bristle.theta_0 = -0.0; }),
      key([](PassageTask& t) { t.start.r = 0.8; }),
      key([](PassageTask& t) { t.start.phi = 0.7; }),
      key([](PassageTask& t) { t.integrator.rtol = 1e-5; }),
      key([](PassageTask& t) { t.integrator.atol = 1e-5; }),
      key([](PassageTask& t) { t.integrator.method = Method::explicit_only; }),
      key([](PassageTask& t) { t.integrator.max_evaluations = 7; }),
  };
  CHECK(keys.size() == 10);
  CHECK_FALSE(keys.contains(memo.key_of({task_of(p)}, Engine::fast)));
  CHECK(key([](PassageTask&) {}) == key([](PassageTask& t) { t.bristle.k_r = 7; }));  // of the brush
}

TEST_CASE("memo of passages: brushes that differ in any parameter, choice, law or engine share nothing") {
  PassageMemo memo;
  const Sweep sweep = two_loads();
  memo.share(sweep, {0, 1});
  const auto shared = [&](const Parameters& p, Engine engine = Engine::fast) {
    return !memo.key_of({task_of(p)}, engine).empty();
  };
  const Parameters known = parameters_of(sweep);
  CHECK(shared(known));
  CHECK_FALSE(shared(known, Engine::reference));
  for (const Parameter& row : kParameters) {
    CAPTURE(row.name);
    Parameters other = known;
    other.*row.member = std::isfinite(known.*row.member) ? known.*row.member * (1 + 1e-15) : 1;
    CHECK_FALSE(shared(other));
  }
  for (const Choice& choice : choices()) {
    CAPTURE(choice.name);
    Parameters other = known;
    choice.set(other, 1 - choice.get(other));
    CHECK_FALSE(shared(other));
  }
  const ModulationTable table(1, std::vector<double>(8, 0.5));
  Parameters other = known;
  other.custom_friction.table = &table;
  CHECK_FALSE(shared(other));
  other = known;
  other.custom_friction.V_0 = 2;
  CHECK_FALSE(shared(other));
  // A member that is added later is in these bytes.
  for (std::size_t i = 0; i < sizeof(Parameters); ++i) {
    std::array<unsigned char, sizeof(Parameters)> bytes;
    std::memcpy(bytes.data(), &known, sizeof known);
    bytes[i] ^= 1;
    Parameters changed;
    std::memcpy(static_cast<void*>(&changed), bytes.data(), sizeof changed);
    const PassageTask task = {&changed, make_bristle(known, 0.5, 1), {0.9, 0.6}, {}};
    CHECK(memo.key_of({task}, Engine::fast).empty());
  }
}

TEST_CASE(
    "memo of passages: brushes of several points are shared, and their points come one after the other") {
  const Scratch s;
  const auto shared = [](const Experiment& e) {
    PassageMemo memo;
    std::vector<std::size_t> points(e.sweep.size());
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = i;
    std::vector<std::size_t> order = memo.share(e.sweep, points);
    std::size_t count = 0;
    for (const std::size_t i : points) {
      const PointInput point = e.sweep.point(i);
      count += !memo.key_of({task_of(point.setup.parameters)}, e.sweep.engine).empty();
    }
    return std::pair(count, order);
  };
  using Order = std::vector<std::size_t>;
  CHECK(shared(loaded(s, R"("sweep": {"path": {"values": ["loading", "unloading"]},
                                      "k_r": {"values": [5, 8]}, "R_n": {"values": [1, 2]}})")) ==
        std::pair<std::size_t, Order>(8, {0, 1, 4, 5, 2, 3, 6, 7}));
  CHECK(shared(loaded(s, R"("sweep": {"k_r": {"values": [5, 8, 9]}})")) ==
        std::pair<std::size_t, Order>(0, {0, 1, 2}));
  // The friction of rigid bristles over the load fixes another tau_f for each load.
  CHECK(
      shared(loaded(s, R"("load": {"nominal_friction": 0.5}, "sweep": {"R_n": {"values": [1, 2]}})")).first ==
      0);
  // Points at given gaps have no gap in common, unless something else varies.
  CHECK(shared(loaded(s, R"("load": {"R_n": null}, "sweep": {"z_0": {"values": [0.4, 0.5]}})")).first == 0);
  CHECK(shared(loaded(s, R"("load": {"R_n": null, "z_0": 0.5}, "sweep": {"concentration": {"values": [1, 2]}},
                            "orientation": {"distribution": "von_mises", "concentration": 1, "mean_deg": 0})"))
            .first == 2);
}

TEST_CASE("memo of passages: its memory is bounded, and it forgets what was used least recently") {
  constexpr std::size_t kEach = 10;  // passages of a request
  for (const std::size_t bytes : {0, 100, 20'000, 1'000'000}) {
    CAPTURE(bytes);
    PassageMemo memo(bytes);
    const std::size_t most = bytes / sizeof(Passage) / kEach;  // requests
    std::vector<Passage> passages(kEach);
    const RequestKey first(1 + 8 * kEach, 0);
    for (std::uint64_t i = 0; i < most + 10; ++i) {
      passages.back().steps = long(i);
      RequestKey key = first;
      key.back() = i;
      memo.store(key, passages);
      memo.find(first);
    }
    const auto found = [&](std::uint64_t i) {
      RequestKey key = first;
      key.back() = i;
      const auto known = memo.find(key);
      return known ? std::optional(known->back().steps) : std::nullopt;
    };
    CHECK(memo.size() * (sizeof(Passage) + 8 * sizeof(std::uint64_t)) <= bytes);
    CHECK(memo.size() >= most * kEach / 2);
    if (memo.size() < 2 * kEach) continue;
    CHECK(found(0) == 0);
    CHECK_FALSE(found(1));
    CHECK(found(most + 9) == long(most + 9));
    CHECK_FALSE(found(most + 10));
  }
  PassageMemo none(0);
  const Sweep sweep = two_loads();
  CHECK(none.share(sweep, {1, 0}) == std::vector<std::size_t>{1, 0});
  CHECK(none.key_of({task_of(parameters_of(sweep))}, Engine::fast).empty());
}

TEST_CASE("memo of passages: a request in flight is not computed again, and a known one comes at once") {
  PassageMemo memo;
  const Sweep sweep = two_loads();
  memo.share(sweep, {0, 1});
  const Parameters p = parameters_of(sweep);
  PassageQueue queue(1, &memo);
  const auto add = [&](const std::vector<PassageTask>& tasks, PassageRequest& request) {
    request.expect(tasks.size());
    queue.add(tasks, request);
  };
  const std::vector<PassageTask> tasks = tasks_of(p, 0, 100), others = tasks_of(p, 0, 99);
  PassageRequest a, b, c, d;
  add(tasks, a);
  add(tasks, b);
  add(tasks, c);
  add(others, d);
  CHECK_FALSE((a.complete() || b.complete() || c.complete() || d.complete()));
  CHECK(compute_all(queue) == 199);
  for (PassageRequest* const request : {&a, &b, &c}) check_azimuths(*request, tasks);
  check_azimuths(d, others);
  CHECK(memo.size() == 199);
  add(tasks, c);
  check_azimuths(c, tasks);
  CHECK(compute_all(queue) == 0);
  // Passages with samples are computed each time.
  std::vector<PassageTask> sampled = tasks_of(p, 0, 3);
  for (PassageTask& task : sampled) task.sample_interval = 0.1;
  for (int repetition = 0; repetition < 2; ++repetition) {
    add(sampled, a);
    CHECK(compute_all(queue) == 3);
    check_azimuths(a, sampled);
  }
}

TEST_CASE("memo of passages: equal requests end on all threads, with any memory", "[threads]") {
  constexpr std::size_t kThreads = 4, kRequests = 100;
  for (const std::size_t bytes : {std::size_t(10'000), run::kMemoBytes})
    for (int repetition = 0; repetition < 10; ++repetition) {
      PassageMemo memo(bytes);
      const Sweep sweep = two_loads();
      memo.share(sweep, {0, 1});
      const Parameters p = parameters_of(sweep);
      PassageQueue queue(kThreads, &memo);
      std::atomic<std::size_t> computed = 0, ended = 0;
      std::array<bool, kThreads> equal{};
      const auto work = [&](std::size_t thread) {
        equal[thread] = true;
        PassageRequest request;
        for (std::size_t k = 0; k < kRequests; ++k) {
          const std::vector<PassageTask> tasks = tasks_of(p, int(k) / 2, 20);
          request.expect(tasks.size());
          queue.add(tasks, request);
          while (!request.complete()) {
            while (const auto chunk = queue.take(0)) computed += compute(queue, *chunk);
            queue.wait([&] { return request.complete(); });
          }
          const std::vector<Passage> passages = request.take();
          for (std::size_t i = 0; i < tasks.size(); ++i)
            equal[thread] = equal[thread] && passages[i].theta_0 == tasks[i].bristle.theta_0;
        }
        // Computes what others wait for.
        for (++ended; ended < kThreads;) {
          while (const auto chunk = queue.take(0)) computed += compute(queue, *chunk);
          queue.wait([&] { return ended == kThreads; });
        }
        queue.notify();
      };
      std::vector<std::thread> threads;
      for (std::size_t i = 0; i < kThreads; ++i) threads.emplace_back(work, i);
      for (std::thread& thread : threads) thread.join();
      CHECK(std::ranges::all_of(equal, [](bool all) { return all; }));
      if (bytes == run::kMemoBytes) CHECK(computed == kRequests / 2 * 20);
    }
}

}  // namespace bristle::passage_memo_test
