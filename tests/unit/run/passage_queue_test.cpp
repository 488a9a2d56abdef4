#include "run/passage_queue.hpp"

#include <algorithm>
#include <array>
#include "catch.hpp"
#include <thread>

namespace bristle::passage_queue_test {
using run::PassageQueue;
using run::PassageRequest;

// Computes passages until all requests are complete. A passage has the azimuth of its task.
void compute_passages(PassageQueue& queue, const std::array<PassageRequest, 2>& requests) {
  const auto done = [&] { return std::ranges::all_of(requests, &PassageRequest::complete); };
  while (!done()) {
    while (const auto chunk = queue.take(0))
      for (std::size_t i = chunk->first; i < chunk->last; ++i) {
        Passage passage;
        passage.theta_0 = (*chunk->tasks)[i].bristle.theta_0;
        queue.deliver(*chunk->request, i, std::move(passage));
      }
    queue.wait(done);
  }
}

TEST_CASE("passage queue: all threads compute the passages of two points, and end", "[threads]") {
  constexpr std::size_t kThreads = 4, kPassages = 1000;
  for (int repetition = 0; repetition < 50; ++repetition) {
    PassageQueue queue(kThreads);
    std::vector<PassageTask> tasks(kPassages);
    for (std::size_t i = 0; i < kPassages; ++i) tasks[i].bristle.theta_0 = double(i);
    std::array<PassageRequest, 2> requests;
    for (PassageRequest& request : requests) request.expect(kPassages);
    std::vector<std::thread> threads;
    for (std::size_t k = 0; k < kThreads; ++k)
      threads.emplace_back([&, k] {
        if (k < requests.size()) queue.add(tasks, requests[k]);
        compute_passages(queue, requests);
      });
    for (std::thread& thread : threads) thread.join();
    for (PassageRequest& request : requests) {
      const std::vector<Passage> passages = request.take();
      for (std::size_t i = 0; i < kPassages; ++i) REQUIRE(passages[i].theta_0 == double(i));
    }
  }
}

TEST_CASE("passage queue: a chunk is taken once, by a thread that has not enough passages") {
  PassageQueue queue(2);
  const std::vector<PassageTask> tasks(100);
  PassageRequest request;
  request.expect(tasks.size());
  queue.add(tasks, request);
  CHECK_FALSE(queue.take(1000));
  for (const std::size_t first : {0, 64}) {
    const auto chunk = queue.take(1);
    REQUIRE(chunk);
    CHECK(chunk->first == first);
    CHECK(chunk->last == (first == 0 ? 64 : 100));
  }
  CHECK_FALSE(queue.take(0));
}

}  // namespace bristle::passage_queue_test
