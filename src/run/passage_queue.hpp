#pragma once

#include "bristle/dynamics/passage.hpp"
#include "run/passage_memo.hpp"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <unordered_map>

namespace bristle::run {

// Collects the passages that one point waits for. Any threads deliver the passages, each once; the thread of
// the point takes them when all have been delivered.
class PassageRequest {
 public:
  void expect(std::size_t count) {
    passages_.assign(count, {});
    outstanding_ = count;
  }
  bool complete() const { return outstanding_.load(std::memory_order_acquire) == 0; }
  // Stores a passage. Returns true for the last one; the request may then have ended its life.
  bool deliver(std::size_t index, Passage&& passage) {
    passages_[index] = std::move(passage);
    return outstanding_.fetch_sub(1, std::memory_order_acq_rel) == 1;
  }
  std::vector<Passage> take() { return std::move(passages_); }

  std::vector<PassageKey> keys;  // of the passages in the memo; none if they are not to be remembered

 private:
  std::vector<Passage> passages_;
  std::atomic<std::size_t> outstanding_ = 0;
};

// Some of the passages of a request, to be computed by one thread.
struct PassageChunk {
  const std::vector<PassageTask>* tasks;
  std::size_t first, last;  // first is included, last is not
  PassageRequest* request;
};

// Queues the passages that the points of a sweep wait for, for all threads. All functions may be called from
// several threads.
class PassageQueue {
 public:
  // Creates an empty queue. memo: has passages of earlier requests; null: the passages of each request are
  // computed
  explicit PassageQueue(std::size_t threads, PassageMemo* memo = nullptr, Engine engine = Engine::fast)
      : threads_(threads), memo_(memo), engine_(engine) {}

  // Adds passages, except passages that the memo has, and passages that are being computed for another
  // request. The request receives the former at once, and may then be complete; it receives the latter
  // together with the other request. tasks and request must live until the request is complete or no thread
  // takes chunks any more.
  void add(const std::vector<PassageTask>& tasks, PassageRequest& request);
  // Delivers a computed passage of a chunk to its request, and to all requests that wait for this passage.
  void deliver(PassageRequest& request, std::size_t index, Passage&& passage);
  // Returns the next chunk for a thread that has `passages` passages; none if the thread has enough, or if it
  // has any while another thread has none.
  std::optional<PassageChunk> take(std::size_t passages);
  // Waits until there is a chunk or done() holds, but only for a moment.
  void wait(const std::function<bool()>& done);
  // Wakes the waiting threads. Call it when the result of done() may have changed, for example because a
  // passage completed a request.
  void notify();

 private:
  // A passage that a request expects.
  struct Expected {
    PassageRequest* request;
    std::size_t index;
  };

  bool comes_without_chunk(PassageRequest& request, std::size_t index);

  const std::size_t threads_;
  PassageMemo* const memo_;
  const Engine engine_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<PassageChunk> chunks_;
  std::size_t waiting_ = 0;  // threads without passages
  // What else waits for a passage of a chunk, until the passage is delivered.
  std::unordered_map<PassageKey, std::vector<Expected>, PassageKeyHash> in_flight_;
};

}  // namespace bristle::run
