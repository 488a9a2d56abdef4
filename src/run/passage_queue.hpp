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
// the point takes them when the request is complete.
class PassageRequest {
 public:
  void expect(std::size_t count) {
    passages_.assign(count, {});
    outstanding_ = count;
    complete_ = count == 0;
  }
  bool complete() const { return complete_.load(std::memory_order_acquire); }
  std::vector<Passage> take() { return std::move(passages_); }

 private:
  friend class PassageQueue;

  // Stores a passage. Returns true for the last one, whose thread then calls set_complete().
  bool deliver(std::size_t index, Passage&& passage) {
    passages_[index] = std::move(passage);
    return outstanding_.fetch_sub(1, std::memory_order_acq_rel) == 1;
  }
  // Stores all passages.
  void deliver_all(std::vector<Passage> passages) {
    passages_ = std::move(passages);
    set_complete();
  }
  // Lets the thread of the point take the passages. The request may have ended its life afterwards.
  void set_complete() { complete_.store(true, std::memory_order_release); }

  RequestKey key_;  // of the request in the memo; empty if its passages are not to be remembered
  std::vector<Passage> passages_;
  std::atomic<std::size_t> outstanding_ = 0;
  std::atomic<bool> complete_ = true;
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

  // Adds the passages of a request, unless the memo has them, or the same passages are being computed for
  // another request. In the first case, the request is complete at once; in the second, it is complete
  // together with the other request. tasks and request must live until the request is complete or no thread
  // takes chunks any more.
  void add(const std::vector<PassageTask>& tasks, PassageRequest& request);
  // Delivers a computed passage of a chunk to its request. The last one completes the request, and all
  // requests that wait for the same passages.
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
  bool comes_without_chunks(PassageRequest& request);

  const std::size_t threads_;
  PassageMemo* const memo_;
  const Engine engine_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<PassageChunk> chunks_;
  std::size_t waiting_ = 0;  // threads without passages
  // The requests that are being computed, and what other requests wait for the same passages.
  std::unordered_map<RequestKey, std::vector<PassageRequest*>, RequestKeyHash> in_flight_;
};

}  // namespace bristle::run
