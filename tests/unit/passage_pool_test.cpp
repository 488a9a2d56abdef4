#include "run/passage_pool.hpp"

#include <array>
#include "catch.hpp"
#include <thread>

namespace bristle::passage_pool_test {
using run::PassagePool;
using run::PassageRequest;

// Delivers passages until all points have been solved. A passage has the azimuth of its task.
void deliver_passages(PassagePool& pool, const PassageRequest* own) {
  bool joined = own != nullptr;
  const auto done = [&] { return joined && own->complete(); };
  do {
    while (const auto chunk = pool.take(0))
      for (std::size_t i = chunk->first; i < chunk->last; ++i) {
        Passage passage;
        passage.theta_0 = (*chunk->tasks)[i].bristle.theta_0;
        if (chunk->request->deliver(i, std::move(passage))) pool.notify();
      }
    if (!done()) continue;
    pool.leave();
    joined = false;
  } while (pool.wait(done));
}

TEST_CASE("passage pool: all threads compute the passages of two points, and end") {
  constexpr std::size_t kPoints = 2, kThreads = 4, kPassages = 1000;
  for (int repetition = 0; repetition < 50; ++repetition) {
    PassagePool pool(kThreads);
    std::vector<PassageTask> tasks(kPassages);
    for (std::size_t i = 0; i < kPassages; ++i) tasks[i].bristle.theta_0 = double(i);
    std::array<PassageRequest, kPoints> requests;
    for (std::size_t k = 0; k < kPoints; ++k) pool.join();
    std::vector<std::thread> threads;
    for (std::size_t k = 0; k < kThreads; ++k)
      threads.emplace_back([&, k] {
        PassageRequest* own = k < kPoints ? &requests[k] : nullptr;
        if (own) {
          own->expect(kPassages);
          pool.share(tasks, 0, *own);
        }
        deliver_passages(pool, own);
      });
    for (std::thread& thread : threads) thread.join();
    for (PassageRequest& request : requests) {
      REQUIRE(request.complete());
      const std::vector<Passage> passages = request.take();
      for (std::size_t i = 0; i < kPassages; ++i) REQUIRE(passages[i].theta_0 == double(i));
    }
  }
}

TEST_CASE("passage pool: a chunk is taken once, by a thread that has not enough passages") {
  PassagePool pool(2);
  const std::vector<PassageTask> tasks(100);
  PassageRequest request;
  request.expect(tasks.size());
  CHECK(pool.chunk_size(1) == 16);
  CHECK(pool.chunk_size(100) == 64);
  pool.share(tasks, 64, request);
  CHECK_FALSE(pool.take(1000));
  const auto chunk = pool.take(1);
  REQUIRE(chunk);
  CHECK(chunk->first == 64);
  CHECK(chunk->last == 100);
  CHECK_FALSE(pool.take(0));
}

}  // namespace bristle::passage_pool_test
